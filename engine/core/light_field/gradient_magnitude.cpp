// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/light_field/gradient_magnitude.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope {
namespace {

void gradient_norms(const float* here, const float* below, int width, int channels, float* out) {
  for (int x = 0; x < width; ++x) {
    const int right = x + 1 < width ? channels : 0;
    float energy = 0;
    for (int c = 0; c < channels; ++c) {
      const int i = x * channels + c;
      const float dx = here[i + right] - here[i];
      const float dy = below[i] - here[i];
      energy += dx * dx + dy * dy;
    }
    out[x] = std::sqrt(energy);
  }
}

}  // namespace

void gradient_magnitude(const LightField& light_field, ViewIndex view, ImageView<float> out) {
  const LightField& lf = light_field;
  std::vector<float> here(static_cast<std::size_t>(lf.width()) * lf.channels());
  std::vector<float> below(here.size());
  lf.read_row(view, 0, 0, lf.width(), here.data());
  for (int y = 0; y < lf.height(); ++y) {
    lf.read_row(view, std::min(y + 1, lf.height() - 1), 0, lf.width(), below.data());
    gradient_norms(here.data(), below.data(), lf.width(), lf.channels(), out.row(y));
    here.swap(below);
  }
}

}  // namespace episcope
