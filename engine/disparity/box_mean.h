// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace episcope {

/// out[x] = the mean of in[x − radius … x + radius], of those within [0, width).
inline void box_mean_row(const float* in, int width, int radius, float* out) {
  for (int x = 0; x < width; ++x) {
    const int begin = std::max(x - radius, 0);
    const int end = std::min(x + radius + 1, width);
    float sum = 0;
    for (int i = begin; i < end; ++i) sum += in[i];
    out[x] = sum / static_cast<float>(end - begin);
  }
}

}  // namespace episcope
