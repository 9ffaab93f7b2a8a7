// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/labeling/ray_labeling.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace episcope {

/// Smooths the view `reference` alone; its local colors (`LocalColors`) then reweight the label
/// probabilities of all views. Pixels of other views are looked up in it by their disparity. A
/// pixel keeps its probabilities where that is unknown, or where one label has more than 0.95.
///
/// `probabilities` take the place of those in `input`, and include `reference`. Throws Cancelled.
void reweight_by_color(const RayLabelingInput& input, ViewIndex reference,
                       const RayLabelingParameters& parameters, const Progress& progress,
                       LabelProbabilities& probabilities);

/// Reweights the probabilities of one view by its own local colors, from its labels `layers`
/// `[y][x]`, 0 … L − 1, that are known already. Throws Cancelled.
void reweight_view_by_color(const LightField& light_field, ViewIndex view,
                            const Image<std::int32_t>& layers, const Progress& progress,
                            ProbabilityMap& probabilities);

/// The colors of each label near each place of a labeled view. Strokes may be far from a boundary
/// and in other light, and estimated disparity is too wide beside it; colors of smoothed labels
/// within a few px decide better there. An addition to [WSG13]; tests/accuracy/tuning.md has the
/// gain.
///
/// Counts the pixels of each label in the 3×3 squares of kSquare_px around a place. Pixels beside
/// another label count a tenth, because they are mixed or mistaken.
class LocalColors {
 public:
  /// `colors` of the view, L*a*b* divided by 100; `labels` in [0, label_count), one a pixel.
  LocalColors(ImageView<const float> colors, ImageView<const std::int32_t> labels, int label_count);

  /// Least share of a probability that colors leave, and the share left to a label that is not
  /// nearby, which smoothing may just have lost.
  static constexpr float kLeastShare = 0.135F;
  static constexpr float kShareElsewhere = 0.7F;

  /// Adds 0.01 to each probability of the pixel at `y`, `x`, multiplies it by its share of color,
  /// and normalizes the sum to 1. The share is 1/(v + |c − m|²) relative to the best label, at
  /// least kLeastShare: m is the mean color of the label there, v the variance of its colors plus
  /// 0.03. A label that is not nearby keeps kShareElsewhere. Places outside count as the border.
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
