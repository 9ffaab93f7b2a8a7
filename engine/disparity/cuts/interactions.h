// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/disparity/cuts/camera_star.h"

#include <cstdint>
#include <vector>

namespace episcope {

/// How the intensities of two pixels that see one point are compared: as they are, at whole pixels
/// [KZ02], or each with the other view interpolated cubically at the exact place, averaged.
enum class Comparison { WholePixels, BetweenPixels };

/// The data term of [KZ02]: pixels of the reference view and of a side view that see the same point
/// at a label interact, and gain by it D = min(0, |I_p − I_q|² − K) ≤ 0, where |…|² is the mean of
/// the squares over the channels, samples in 1/255. In units of K/kUnit, whole numbers, so that
/// sums are exact.
class Interactions {
 public:
  static constexpr std::int32_t kUnit = 1000;

  /// `limit` K > 0, or 0 to find it: the mean, over pixels and side views, of the difference at the
  /// label that a quarter of the labels match better than. That is the published heuristic [KMT14].
  Interactions(const LightField& light_field, ViewIndex reference, std::vector<SideView> sides,
               Comparison comparison, double limit, const Progress& progress);

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
  void find_limit(const Progress& progress);

  int height_;
  int width_;
  Comparison comparison_;
  double limit_;
  std::vector<SideView> sides_;
  std::vector<CameraImage> images_;
};

}  // namespace episcope
