// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Two ways to run a step: by the whole device, or by one block for each view, which waits for
/// itself between steps and so needs no launches for levels of few pixels.

#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/tv_l2/tv_l2_level.cuh"

namespace episcope::cuda {

/// The places of a step: rows and places in a row.
struct TvL2Extent {
  int rows = 0, places = 0;
};
__host__ __device__ inline TvL2Extent extent_of(const TvL2Level& level) {
  return {level.height, level.half()};
}
/// Of a step from cells of `fine` to `coarse`, one place for each cell.
__host__ __device__ inline TvL2Extent cells_of(const TvL2Level& coarse) {
  return {coarse.height, coarse.width};
}

template <class Step>
__global__ void run_step(Step step, TvL2Extent extent, const TvL2View* views) {
  const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
  const int view = static_cast<int>(blockIdx.z);
  if (i >= extent.places || y >= extent.rows || views[view].is_active == 0) return;
  step(view, y, i);
}

/// By the whole device. So many `floats` are read or written, and `operations` done, for each
/// place.
template <class Step>
void run_on_grid(const DeviceStream& stream, const char* name, const Step& step, TvL2Extent extent,
                 int view_count, const TvL2View* views, double floats, double operations) {
  const dim3 block(32, 8);
  const dim3 grid(blocks_for(extent.places, 32), blocks_for(extent.rows, 8),
                  static_cast<unsigned>(view_count));
  const double places = static_cast<double>(extent.rows) * extent.places * view_count;
  launch(stream, {name, places * floats * sizeof(float), places * operations},
         [&] { run_step<<<grid, block, 0, stream.get()>>>(step, extent, views); });
}

/// By the block of a view: returns when all of it is done.
template <class Step>
__device__ void run_in_block(const Step& step, TvL2Extent extent, int view) {
  const int warp = static_cast<int>(threadIdx.x) / 32, warps = static_cast<int>(blockDim.x) / 32;
  for (int y = warp; y < extent.rows; y += warps) {
    for (int i = static_cast<int>(threadIdx.x) % 32; i < extent.places; i += 32) step(view, y, i);
  }
  __syncthreads();
}

}  // namespace episcope::cuda
