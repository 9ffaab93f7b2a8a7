// SPDX-License-Identifier: BSD-3-Clause
// Compiled once for each instruction set: see engine/core/parallel/isa.h for what may stand here.
#include "engine/labeling/features/stroke_distance_kernel.h"

#include "engine/core/parallel/simd.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

// Pixels wait for their neighbours along x, so the vectors run over the labels.
inline void shorten(const DistanceGrid& grid, long to, long from, float way) {
  float* own = grid.distances + to * grid.pitch;
  const float* other = grid.distances + from * grid.pitch;
  const Vec length = splat(way);
  for (int l = 0; l < grid.pitch; l += kLanes) {
    store(own + l, least(load(own + l), load(other + l) + length));
  }
}

void sweep_down(const DistanceGrid& grid, int y) {
  const long width = grid.width;
  for (long x = 0, i = y * width; x < width; ++x, ++i) {
    if (x > 0) shorten(grid, i, i - 1, grid.ways[0][i - 1]);
    if (y == 0) continue;
    shorten(grid, i, i - width, grid.ways[1][i - width]);
    if (x > 0) shorten(grid, i, i - width - 1, grid.ways[2][i - width - 1]);
    if (x + 1 < width) shorten(grid, i, i - width + 1, grid.ways[3][i - width + 1]);
  }
}

void sweep_up(const DistanceGrid& grid, int y) {
  const long width = grid.width;
  for (long x = width - 1, i = y * width + x; x >= 0; --x, --i) {
    if (x + 1 < width) shorten(grid, i, i + 1, grid.ways[0][i]);
    if (y + 1 == grid.height) continue;
    shorten(grid, i, i + width, grid.ways[1][i]);
    if (x + 1 < width) shorten(grid, i, i + width + 1, grid.ways[2][i]);
    if (x > 0) shorten(grid, i, i + width - 1, grid.ways[3][i]);
  }
}

}  // namespace

const StrokeDistanceKernel kStrokeDistanceKernel = {sweep_down, sweep_up};

}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
