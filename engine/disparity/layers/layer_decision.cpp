// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layers/layer_decision.h"

#include <algorithm>

namespace episcope {
namespace {

constexpr int kReach = 2;

}  // namespace

void spread_coherence(ImageView<const float> coherence, Image<float>& rows, Image<float>& spread) {
  const int height = coherence.height, width = coherence.width;
  for (int y = 0; y < height; ++y) {
    const float* from = coherence.row(y);
    float* to = rows.row(y);
    for (int x = 0; x < width; ++x) {
      const int begin = std::max(0, x - kReach), end = std::min(width, x + kReach + 1);
      to[x] = *std::max_element(from + begin, from + end);
    }
  }
  for (int y = 0; y < height; ++y) {
    float* to = spread.row(y);
    std::copy_n(rows.row(y), width, to);
    for (int j = std::max(0, y - kReach); j < std::min(height, y + kReach + 1); ++j) {
      const float* from = rows.row(j);
      for (int x = 0; x < width; ++x) to[x] = std::max(to[x], from[x]);
    }
  }
}

}  // namespace episcope
