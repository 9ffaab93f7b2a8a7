// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/schema.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace episcope {

/// A view beside the reference view, in its row or its column of the camera grid, and where it sees
/// what the reference view sees at each label: a point of disparity d lies −d·distance pixels on
/// along that axis. Places are whole pixels, as in [KZ02]; what rounding leaves is kept.
struct SideView {
  ViewIndex view;
  bool is_vertical = false;     ///< The axis: y instead of x.
  std::vector<int> shift{};     ///< Pixels at each label, rounded.
  std::vector<float> beyond{};  ///< Exact minus rounded, in [−½, ½].

  /// Where the side view sees pixel (y, x) at `label`: perhaps beyond the image.
  [[nodiscard]] PixelIndex place(int y, int x, int label) const {
    return is_vertical ? PixelIndex{y + shift[label], x} : PixelIndex{y, x + shift[label]};
  }
  /// The reverse.
  [[nodiscard]] PixelIndex place_in_reference(int y, int x, int label) const {
    return is_vertical ? PixelIndex{y - shift[label], x} : PixelIndex{y, x - shift[label]};
  }
};

/// The views nearest to `distance` view steps left, right, above and below the reference: those
/// that the grid has. Labels are disparities, px per view step.
[[nodiscard]] std::vector<SideView> side_views(GridShape grid, ViewIndex reference, int distance,
                                               const std::vector<float>& labels);

/// The samples of a view in units of 1/255, one plane for each channel, its border repeated by
/// `kMargin` pixels on all sides; NaN where a pixel is not valid.
class CameraImage {
 public:
  static constexpr int kMargin = 2;

  CameraImage(const LightField& light_field, ViewIndex view);

  [[nodiscard]] int channels() const { return static_cast<int>(planes_.size()); }
  /// Pixel (y, 0) of a plane; y and x may leave the image by the margin.
  [[nodiscard]] const float* row(int channel, int y) const {
    return planes_[channel].row(y + kMargin) + kMargin;
  }
  [[nodiscard]] long pitch() const { return planes_[0].width(); }

 private:
  std::vector<Image<float>> planes_;
};

/// How the intensities of two pixels that see one point are compared: each with the other view,
/// interpolated cubically at the exact place, and averaged; or as they are, at whole pixels [KZ02].
enum class PixelComparison { BetweenPixels, WholePixels };
[[nodiscard]] Names<PixelComparison> names_of(PixelComparison);

/// How K is found: from noise, as three times the median of the least difference that a pixel has
/// at any label, at least 30, the value of [KZ02]; or as the mean of the difference that a quarter
/// of the labels fall below, the heuristic of the authors' program [KMT14].
enum class LimitRule { Noise, Quarter };
[[nodiscard]] Names<LimitRule> names_of(LimitRule);

/// What pixels must fulfil to interact.
struct Matching {
  PixelComparison comparison = PixelComparison::BetweenPixels;
  double limit = 0;  ///< K, (1/255)²; 0 = found by `rule`.
  LimitRule rule = LimitRule::Noise;
};

/// The data term of [KZ02]: pixels of the reference view and of a side view that see the same point
/// at a label interact, and gain by it D = min(0, |I_p − I_q|² − K) ≤ 0, where |…|² is the mean of
/// the squares over the channels, samples in 1/255. In units of K/kUnit, whole numbers, so that
/// sums are exact.
class Interactions {
 public:
  static constexpr std::int32_t kUnit = 1000;

  /// Throws Cancelled.
  Interactions(const LightField& light_field, ViewIndex reference, std::vector<SideView> sides,
               const Matching& matching, const Progress& progress);

  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int labels() const { return static_cast<int>(sides_.front().shift.size()); }
  [[nodiscard]] const std::vector<SideView>& sides() const { return sides_; }
  /// View 0 is the reference, 1 the first of the side views.
  [[nodiscard]] const CameraImage& image(int view) const { return images_[view]; }
  [[nodiscard]] double limit() const { return limit_; }

  /// D of row `y` of the reference view and a side view; 0 where that does not see the point.
  void gains(int side, int label, int y, std::int32_t* out) const;

 private:
  // |I_p − I_q|² of columns [first, last) of the row; the others are beyond the other image.
  struct Seen {
    int first = 0, last = 0;
  };
  Seen differences(int side, int label, int y, float* out) const;
  void find_limit(LimitRule rule, const Progress& progress);
  [[nodiscard]] std::vector<float> differences_of_rank(int y, int rank) const;

  int height_;
  int width_;
  PixelComparison comparison_;
  double limit_;  // K
  std::vector<SideView> sides_;
  std::vector<CameraImage> images_;
};

/// The smoothness term of [KZ02]: λ_pq min(|f_p − f_q|, T) between the four neighbors of a pixel,
/// in each view. λ_pq is three times λ where the intensities of the neighbors differ by less than
/// 8/255 in every channel [KMT14].
struct CameraSmoothness {
  std::int32_t weight = Interactions::kUnit / 5;  ///< λ ≥ 0 in units of Interactions.
  int truncation = 3;                             ///< T ≥ 1, in labels.
};

/// One label for every pixel of every view, `[view][y][x]`; larger = nearer.
using CameraLabels = std::vector<Image<std::int16_t>>;

/// The energy of [KZ02] of a labeling of several views at once:
///   E = Σ D(p, q) + Σ λ_pq min(|f_p − f_q|, T) + E_visibility.
/// The first sum runs over interacting pixels with the same label, the second over neighbors in
/// one view. The last is infinite if a pixel claims to look through a point that another view sees:
/// if p has label l, the pixel of the other view on which that point falls must have l or more.
class MultiCameraEnergy {
 public:
  MultiCameraEnergy(const Interactions& interactions, CameraSmoothness smoothness);

  [[nodiscard]] const Interactions& interactions() const { return interactions_; }
  [[nodiscard]] int views() const { return static_cast<int>(to_right_.size()); }
  [[nodiscard]] int truncation() const { return truncation_; }
  /// λ_pq of a pixel and its neighbor to the right, below. 0 at the border.
  [[nodiscard]] const std::int32_t* to_right(int view, int y) const {
    return to_right_[view].row(y);
  }
  [[nodiscard]] const std::int32_t* below(int view, int y) const { return below_[view].row(y); }

  /// All pixels at the farthest label, which sees through nothing.
  [[nodiscard]] CameraLabels farthest() const;
  /// E in units of Interactions; none if visibility is violated.
  [[nodiscard]] std::optional<std::int64_t> of(const CameraLabels& labels) const;

 private:
  [[nodiscard]] std::int64_t smoothness_of(const CameraLabels& labels) const;
  [[nodiscard]] bool is_visible(const CameraLabels& labels) const;

  const Interactions& interactions_;
  int truncation_;
  std::vector<Image<std::int32_t>> to_right_, below_;
};

}  // namespace episcope
