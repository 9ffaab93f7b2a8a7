// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"

namespace episcope::cuda {

/// Disparity and confidence `[v][u][y][x]` of a rectangle of views, on the device. Views of the
/// light field are counted from its first, maps from that of the rectangle.
struct MapPointers {
  GridShape grid;
  ViewIndex first;
  float* disparity = nullptr;
  float* confidence = nullptr;

  /// Which map is that of view (v, u).
  [[nodiscard]] __host__ __device__ int index(int v, int u) const {
    return (v - first.v) * grid.u + (u - first.u);
  }
};

}  // namespace episcope::cuda
