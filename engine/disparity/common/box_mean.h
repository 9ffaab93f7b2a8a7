// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

#include <algorithm>

namespace episcope {

/// out[x] = the sum of rows [y − radius, y + radius] of the image, of those that exist. Returns how
/// many do.
inline int sum_rows(const Image<float>& image, int y, int radius, float* out) {
  const int begin = std::max(y - radius, 0);
  const int end = std::min(y + radius + 1, image.height());
  std::fill_n(out, image.width(), 0.0F);
  for (int i = begin; i < end; ++i) {
    const float* const row = image.row(i);
    for (int x = 0; x < image.width(); ++x) out[x] += row[x];
  }
  return end - begin;
}

/// out[x] = the mean of in[x − radius … x + radius], of those within [0, width).
inline void box_mean_row(const float* in, int width, int radius, float* out) {
  const auto mean_at = [=](int x) {
    const int begin = std::max(x - radius, 0);
    const int end = std::min(x + radius + 1, width);
    float sum = 0;
    for (int i = begin; i < end; ++i) sum += in[i];
    return sum / static_cast<float>(end - begin);
  };
  const int inner = std::min(radius, width), outer = std::max(inner, width - radius);
  for (int x = 0; x < inner; ++x) out[x] = mean_at(x);
  // Shift by shift, which is vectorised.
  std::fill(out + inner, out + outer, 0.0F);
  for (int i = -radius; i <= radius; ++i) {
    for (int x = inner; x < outer; ++x) out[x] += in[x + i];
  }
  const auto count = static_cast<float>(2 * radius + 1);
  for (int x = inner; x < outer; ++x) out[x] /= count;
  for (int x = outer; x < width; ++x) out[x] = mean_at(x);
}

/// out[x] = the mean of the pixels of the image within `radius` of (y, x) along both axes.
/// `columns` holds a row meanwhile.
inline void window_mean_row(const Image<float>& image, int y, int radius, float* columns,
                            float* out) {
  const auto rows = static_cast<float>(sum_rows(image, y, radius, columns));
  box_mean_row(columns, image.width(), radius, out);
  for (int x = 0; x < image.width(); ++x) out[x] /= rows;
}

}  // namespace episcope
