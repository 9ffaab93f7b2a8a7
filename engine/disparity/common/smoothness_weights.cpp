// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/smoothness_weights.h"

#include "engine/core/light_field/channel_weight.h"
#include "engine/core/light_field/gradient_magnitude.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

// What an invalid pixel holds is no edge, nor where it begins.
void ignore_invalid(ImageView<const std::uint8_t> valid, Image<float>& weights) {
  for (int y = 0; y < valid.height; ++y) {
    const std::uint8_t* const here = valid.row(y);
    const std::uint8_t* const below = valid.row(std::min(y + 1, valid.height - 1));
    for (int x = 0; x < valid.width; ++x) {
      const int right = std::min(x + 1, valid.width - 1);
      if (here[x] == 0 || here[right] == 0 || below[x] == 0) weights.at(y, x) = 1;
    }
  }
}

}  // namespace

Image<float> smoothness_weights(const LightField& lf, ViewIndex view, double beta,
                                double noise_variance) {
  Image<float> weights(lf.height(), lf.width(), 1, 1.0F);
  if (beta == 0) return weights;
  gradient_magnitude(lf, view, weights.view());
  const auto strength = static_cast<float>(-beta * std::sqrt(channel_weight(lf.channels())));
  const auto of_noise = static_cast<float>(4 * lf.channels() * noise_variance);
  for (float& weight : weights) {
    weight = std::exp(strength * std::sqrt(std::max(0.0F, weight * weight - of_noise)));
  }
  if (!lf.valid().empty()) ignore_invalid(lf.valid_of(view), weights);
  return weights;
}

}  // namespace episcope
