// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/edge_weights.h"

#include "engine/core/light_field/edge_strength.h"

#include <cmath>

namespace episcope {

Image<float> edge_weights(const LightField& lf, ViewIndex view, double beta) {
  Image<float> weights(lf.height(), lf.width(), 1, 1.0F);
  if (beta == 0) return weights;
  image_edge_strength(lf, view, weights.view());
  const auto strength = static_cast<float>(-beta);
  for (float& weight : weights) weight = std::exp(strength * weight);
  return weights;
}

}  // namespace episcope
