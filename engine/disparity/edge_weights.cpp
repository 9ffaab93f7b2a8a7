// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/edge_weights.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope {
namespace {

// Squared forward differences of a row, channels summed; nothing beyond the last row and column.
void gradient_energy(const float* here, const float* below, int width, int channels, float* out) {
  for (int x = 0; x < width; ++x) {
    const int right = x + 1 < width ? channels : 0;
    float energy = 0;
    for (int c = 0; c < channels; ++c) {
      const int i = x * channels + c;
      const float dx = here[i + right] - here[i];
      const float dy = below[i] - here[i];
      energy += dx * dx + dy * dy;
    }
    out[x] = energy;
  }
}

}  // namespace

Image<float> edge_weights(const LightField& lf, ViewIndex view, double beta) {
  Image<float> weights(lf.height(), lf.width(), 1, 1.0F);
  if (beta == 0) return weights;
  const int channels = lf.channels();
  std::vector<float> here(static_cast<std::size_t>(lf.width()) * channels);
  std::vector<float> below(here.size());
  lf.read_row(view, 0, 0, lf.width(), here.data());
  for (int y = 0; y < lf.height(); ++y) {
    lf.read_row(view, std::min(y + 1, lf.height() - 1), 0, lf.width(), below.data());
    float* row = weights.row(y);
    gradient_energy(here.data(), below.data(), lf.width(), channels, row);
    const auto strength = static_cast<float>(-beta);
    for (int x = 0; x < lf.width(); ++x) row[x] = std::exp(strength * std::sqrt(row[x]));
    here.swap(below);
  }
  return weights;
}

}  // namespace episcope
