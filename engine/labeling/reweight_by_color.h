// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/labeling/label_probabilities.h"
#include "engine/labeling/ray_labeling.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace episcope {

/// Weighs the probabilities of all views by how well the colour of each pixel fits what has its
/// label nearby (`LocalColors`). What is nearby tells the view `reference`, whose labels are
/// smoothed once, by itself, for it; pixels of other views are looked for there by their disparity
/// and stay as they are where that is not known. Pixels with a label of more than 0.95 stay as
/// well.
///
/// `input` without probabilities: those are `probabilities`, of the same views, `reference` among
/// them. Throws Cancelled.
void judge_colors(const RayLabelingInput& input, ViewIndex reference,
                  const RayLabelingParameters& parameters, const Progress& progress,
                  LabelProbabilities& probabilities);

/// The colours that each label has near each place of a labeled view. Labels that were smoothed
/// know more about the colours beside a boundary than the strokes do, which may be far away and in
/// other light, and a few px around a boundary these colours say more than an estimated disparity,
/// which is too wide there. An own addition to [WSG13]; what it gains is in
/// tests/accuracy/tuning.md.
///
/// Counted are the pixels of each label in 3×3 squares of kSquare_px around that of the place,
/// those beside another label a tenth, because they are mixed or mistaken.
class LocalColors {
 public:
  /// `colors` of the view, L*a*b* divided by 100; `labels` in [0, label_count), one a pixel.
  LocalColors(ImageView<const float> colors, ImageView<const std::int32_t> labels, int label_count);

  /// Least share that colours leave of a probability, and what they leave of that of a label which
  /// is not nearby: smoothing may just have lost it.
  static constexpr float kLeastShare = 0.135F;
  static constexpr float kShareElsewhere = 0.7F;

  /// Multiplies the probabilities of a pixel at `y`, `x` by 1/(v + |c − m|²), m the mean colour of
  /// the label there, v the variance of its colours and a noise of 0.03, relative to the label for
  /// which that is most but at least kLeastShare, and makes them sum to 1 again. Labels that are
  /// not nearby keep kShareElsewhere. Before, 0.01 is added to each. Places outside count as those
  /// at the border.
  void weigh(std::array<float, 3> color, float y, float x, std::span<float> probabilities) const;

 private:
  struct Sums {
    float weight = 0;
    std::array<float, 3> colors{};
    float squares = 0;
    Sums& operator+=(const Sums& other);
  };
  /// Of a label that is not nearby the variance is infinite.
  struct Colors {
    std::array<float, 3> mean{};
    float variance = 0;
  };
  [[nodiscard]] std::vector<Sums> sums_of(ImageView<const float> colors,
                                          ImageView<const std::int32_t> labels) const;
  [[nodiscard]] std::size_t index(int row, int column) const {
    return (static_cast<std::size_t>(row) * columns_ + column) * label_count_;
  }
  static Colors colors_of(const Sums& sums);

  int label_count_, square_px_, rows_, columns_;
  std::vector<Colors> near_;  // [row][column][label] of squares
};

}  // namespace episcope
