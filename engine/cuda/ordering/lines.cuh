// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"

namespace episcope::cuda {

/// Maps of all views on the device, `[v][u][y][x]`.
struct OrderedMaps {
  GridShape grid;
  int height = 0, width = 0;

  [[nodiscard]] __host__ __device__ long pixels() const {
    return static_cast<long>(height) * width;
  }
};

/// The four neighbours of a view in the grid. A point moves by −d for each step of u or v.
struct Way {
  int v = 0, u = 0;
  [[nodiscard]] __device__ bool is_vertical() const { return v != 0; }
  [[nodiscard]] __device__ float step() const { return static_cast<float>(-(u + v)); }
};
inline constexpr int kWays = 4;
__device__ inline Way way_of(int i) {
  return {i == 2 ? 1 : i == 3 ? -1 : 0, i == 0 ? 1 : i == 1 ? -1 : 0};
}

/// Where a line ends: between pixels `tap` and the next along its axis; tap < 0 = outside.
struct LineEnd {
  int tap = -1;
  float weight = 0;  ///< Of the next.
};
__device__ inline LineEnd line_end(int start, float step, float slope, int last) {
  const float at = static_cast<float>(start) + step * slope;
  if (!(at >= 0 && at <= static_cast<float>(last))) return {};
  const int tap = min(static_cast<int>(at), max(last - 1, 0));
  return {tap, at - static_cast<float>(tap)};
}

/// Along one axis of a map: the pixel at `position` of the line of pixels through (y, x).
struct Along {
  bool is_vertical = false;
  int y = 0, x = 0;
  int width = 0;
  [[nodiscard]] __device__ long at(int position) const {
    return is_vertical ? static_cast<long>(position) * width + x
                       : static_cast<long>(y) * width + position;
  }
};

/// The difference along a line that ends at `end`: linear between pixels, less `from`.
__device__ inline float line_difference(const float* to, const Along& along, const LineEnd& end,
                                        int last, float from) {
  const float first = to[along.at(end.tap)];
  const float second = to[along.at(min(end.tap + 1, last))];
  return first + end.weight * (second - first) - from;
}

}  // namespace episcope::cuda
