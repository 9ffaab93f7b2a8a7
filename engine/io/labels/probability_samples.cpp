// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/labels/probability_samples.h"

#include <algorithm>
#include <cmath>

namespace episcope::io {

void fill_samples(VolumeView<const std::uint8_t> probabilities, Image<float>& samples) {
  const int labels = probabilities.layers;
  for (int y = 0; y < probabilities.height; ++y) {
    for (int l = 0; l < labels; ++l) {
      const std::uint8_t* in = probabilities.row(y, l);
      float* out = samples.row(y) + l;
      for (int x = 0; x < probabilities.width; ++x) {
        out[static_cast<std::ptrdiff_t>(x) * labels] = in[x] * (1.0F / 255);
      }
    }
  }
}

Volume<std::uint8_t> bytes_of(const Image<float>& samples) {
  Volume<std::uint8_t> map(samples.height(), samples.channels(), samples.width());
  for (int y = 0; y < samples.height(); ++y) {
    for (int l = 0; l < samples.channels(); ++l) {
      std::uint8_t* out = map.view().row(y, l);
      for (int x = 0; x < samples.width(); ++x) {
        const float sample = samples.at(y, x, l);
        const float bounded = std::isnan(sample) ? 0.0F : std::clamp(sample, 0.0F, 1.0F);
        out[x] = static_cast<std::uint8_t>(std::lround(bounded * 255));
      }
    }
  }
  return map;
}

}  // namespace episcope::io
