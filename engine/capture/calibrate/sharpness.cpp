// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/calibrate/sharpness.h"

#include <algorithm>
#include <cmath>

namespace episcope::capture {

double sharpness(ImageView<const std::uint8_t> grey, std::span<const std::array<double, 2>> points,
                 int reach) {
  double sum = 0;
  int count = 0;
  for (const auto& [px, py] : points) {
    const int x0 = std::max(static_cast<int>(px) - reach, 1);
    const int y0 = std::max(static_cast<int>(py) - reach, 1);
    const int x1 = std::min(static_cast<int>(px) + reach, grey.width - 1);
    const int y1 = std::min(static_cast<int>(py) + reach, grey.height - 1);
    int low = 255;
    int high = 0;
    int across = 0;
    int down = 0;
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        const int here = grey.at(y, x);
        low = std::min(low, here);
        high = std::max(high, here);
        across = std::max(across, std::abs(here - grey.at(y, x - 1)));
        down = std::max(down, std::abs(here - grey.at(y - 1, x)));
      }
    }
    if (high - low < 8) continue;
    sum += static_cast<double>(std::min(across, down)) / (high - low);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace episcope::capture
