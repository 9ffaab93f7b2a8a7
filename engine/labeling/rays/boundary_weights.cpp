// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/boundary_weights.h"

#include <algorithm>

namespace episcope {

Image<float> larger_edge_probability(ImageView<const float> edge_probability) {
  const auto& edge = edge_probability;
  Image<float> larger(edge.height, edge.width);
  for (int y = 0; y < edge.height; ++y) {
    for (int x = 0; x < edge.width; ++x) {
      larger.at(y, x) = std::max(edge.at(y, x), edge.at(y, x, edge.channels - 1));
    }
  }
  return larger;
}

Image<float> boundary_weights(ImageView<const float> edge_probability) {
  Image<float> weights = larger_edge_probability(edge_probability);
  for (float& weight : weights) weight = std::clamp(1 - weight, kMinBoundaryWeight, 1.0F);
  return weights;
}

}  // namespace episcope
