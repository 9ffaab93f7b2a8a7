// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/core/parameter/named.h"
#include "engine/disparity/cuts/camera_star.h"

#include <cstdint>
#include <vector>

namespace episcope {

/// How the intensities of two pixels that see one point are compared: each with the other view,
/// interpolated cubically at the exact place, and averaged; or as they are, at whole pixels [KZ02].
enum class Comparison { BetweenPixels, WholePixels };
[[nodiscard]] Names<Comparison> names_of(Comparison);

/// How K is found: from noise, as three times the median of the least difference that a pixel has
/// at any label, at least 30, the value of [KZ02]; or as the mean of the difference that a quarter
/// of the labels fall below, the heuristic of the authors' program [KMT14].
enum class LimitRule { Noise, Quarter };
[[nodiscard]] Names<LimitRule> names_of(LimitRule);

/// What pixels must fulfil to interact.
struct Matching {
  Comparison comparison = Comparison::BetweenPixels;
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
  Comparison comparison_;
  double limit_;  // K
  std::vector<SideView> sides_;
  std::vector<CameraImage> images_;
};

}  // namespace episcope
