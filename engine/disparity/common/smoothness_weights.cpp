// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/smoothness_weights.h"

#include "engine/core/light_field/gradient_magnitude.h"

#include <cmath>

namespace episcope {

Image<float> smoothness_weights(const LightField& lf, ViewIndex view, double beta) {
  Image<float> weights(lf.height(), lf.width(), 1, 1.0F);
  if (beta == 0) return weights;
  gradient_magnitude(lf, view, weights.view());
  const auto strength = static_cast<float>(-beta);
  for (float& weight : weights) weight = std::exp(strength * weight);
  return weights;
}

}  // namespace episcope
