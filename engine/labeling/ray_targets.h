// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"

#include <array>
#include <cstdint>
#include <memory>

namespace episcope {

/// Maximum difference of disparities (px per view step) that count as the same scene point.
/// Estimates are off by about 0.05 to 0.2 px; a smaller step in depth hides less than a pixel over
/// four views.
inline constexpr float kSamePointTolerance_px = 0.25F;

/// Where the rays of row `y` of the view `from` arrive in the view that is `step` = (v, u) away
/// from it: pixel (y, x) of disparity d at (y − d·step.v, x − d·step.u), to the nearest pixel,
/// written as y'·width + x'. −1 where the ray leaves the image, where either disparity is invalid,
/// and where the pixel found has another disparity: there the point is hidden. `targets` has a
/// row's width. Precondition: both views have one size.
void find_ray_targets(const DisparityView& from, const DisparityView& to, ViewIndex step, int y,
                      std::int32_t* targets);

/// Columns of a row from `begin` to before `end`.
struct ColumnRange {
  int begin = 0, end = 0;
};
/// Columns that find_ray_targets processes at once.
inline constexpr int kRayColumns = 16;
/// Finds the targets of kRayColumns columns or more; the other `targets` stay unchanged.
void find_ray_targets(const DisparityView& from, const DisparityView& to, ViewIndex step, int y,
                      ColumnRange columns, std::int32_t* targets);

/// Compares the colors of two rays to decide whether they see the same scene point. Disparities are
/// least accurate at outlines, where a ray of the neighboring object has another color. Where noise
/// or gloss exceeds σ, rays are not coupled. Refers to samples of 8 bits directly; of others it
/// keeps a copy of a rectangle of views, rounded to 8 bits.
class RayColors {
 public:
  /// Knows nothing: all rays are trusted.
  RayColors() = default;
  /// Precondition: the light field has these views, and outlives the object. Throws Cancelled.
  RayColors(const LightField& light_field, GridShape grid, ViewIndex first,
            const Progress& progress);

  /// One row of a view, and a whole other view, to be compared.
  struct Pair {
    const std::uint8_t* row = nullptr;
    const std::uint8_t* other = nullptr;
  };
  [[nodiscard]] Pair pair(ViewIndex view, int y, ViewIndex other) const {
    if (colors_ == nullptr) return {};
    return {colors_->view(view).row(y), colors_->view(other).data};
  }

  /// exp(−|ΔI|²/2σ²) of column x and of pixel `target` = y'·width + x' of the other view, |ΔI| the
  /// difference of their colors, σ = 10/255; 0 beyond 4σ. 1 where nothing is known.
  [[nodiscard]] float trust(const Pair& pair, int x, std::int32_t target) const;
  /// Trust of many columns and their pixels, 0 where the target is −1; the other `trusts` stay
  /// unchanged.
  void trusts(const Pair& pair, ColumnRange columns, const std::int32_t* targets,
              float* trusts) const;

  /// The samples that are compared, 8 bits; null if nothing is known.
  [[nodiscard]] const ViewStack<std::uint8_t>* samples() const { return colors_; }
  /// Trust of each squared difference of colors, summed over three channels; 0 from the last on.
  static constexpr int kNoTrust = 1600;
  [[nodiscard]] const std::array<float, kNoTrust + 1>& trusts() const { return table_; }

 private:
  std::unique_ptr<const ViewStack<std::uint8_t>> rounded_;
  const ViewStack<std::uint8_t>* colors_ = nullptr;  // of the light field, or `rounded_`
  std::array<float, kNoTrust + 1> table_ = {};
};

}  // namespace episcope
