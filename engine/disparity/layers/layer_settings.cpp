// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layers/layer_settings.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope {

TensorScales scales_of_layers(const EpiTwoLayerParameters& parameters) {
  return {parameters.double_inner_scale, parameters.double_outer_scale,
          parameters.tensor.view_scale,  kCrossScaleOfLayers,
          parameters.double_contrast,    parameters.tensor.noise};
}

DoubleSearch layer_search(const EpiTwoLayerParameters& parameters, Interval range) {
  constexpr double kOvershoot = 0.3;
  return {{range.min - kOvershoot, range.max + kOvershoot}, parameters.least_distance};
}

std::vector<std::string> layer_notes(const std::vector<double>& gaps,
                                     const ViewStack<std::uint8_t>& layers) {
  const auto doubles = std::count(layers.data(), layers.data() + layers.size(), 2);
  const double share = 100.0 * static_cast<double>(doubles) / static_cast<double>(layers.size());
  return {fmt::format("two layers in {:.1f} % of the pixels", share),
          gap_note(*std::max_element(gaps.begin(), gaps.end()))};
}

}  // namespace episcope
