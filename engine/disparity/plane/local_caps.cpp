// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/local_caps.h"

#include "engine/core/light_field/channel_weight.h"
#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

// Sums over the channels of products of the gradient.
struct Products {
  float xx = 0, xy = 0, yy = 0;
};

Products gradient_products(const Image<float>& image, int y, int x) {
  const int left = std::max(x - 1, 0), right = std::min(x + 1, image.width() - 1);
  const int up = std::max(y - 1, 0), down = std::min(y + 1, image.height() - 1);
  Products sum;
  for (int c = 0; c < image.channels(); ++c) {
    const float gx = (image.at(y, right, c) - image.at(y, left, c)) / std::max(right - left, 1);
    const float gy = (image.at(down, x, c) - image.at(up, x, c)) / std::max(down - up, 1);
    sum.xx += gx * gx;
    sum.xy += gx * gy;
    sum.yy += gy * gy;
  }
  return sum;
}

float mean_difference(const Products& g, GridShape grid, ViewIndex view) {
  float sum = 0;
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex other = grid.view_at(i);
    const auto u = static_cast<float>(other.u - view.u), v = static_cast<float>(other.v - view.v);
    sum += std::sqrt(std::max(0.0F, u * u * g.xx + 2 * u * v * g.xy + v * v * g.yy));
  }
  return sum / static_cast<float>(grid.count() - 1);
}

}  // namespace

Image<float> local_caps(const LightField& lf, ViewIndex view, const Image<float>& variance,
                        const LocalCapOptions& options, const Progress& progress) {
  const Image<float> image = lf.view_as_float(view);
  const auto of_channels = static_cast<float>(1 / std::sqrt(channel_weight(lf.channels())));
  const float lowest = of_channels * options.lowest, highest = of_channels * options.highest;
  Image<float> caps(lf.height(), lf.width());
  parallel_for(lf.height(), progress, [&](int y) {
    for (int x = 0; x < lf.width(); ++x) {
      const float off =
          options.offset * mean_difference(gradient_products(image, y, x), lf.grid(), view);
      const float noise = std::sqrt(variance.at(y, x) * static_cast<float>(lf.channels()));
      caps.at(y, x) = std::clamp(off, lowest, highest) + options.noise_share * noise;
    }
  });
  return caps;
}

}  // namespace episcope
