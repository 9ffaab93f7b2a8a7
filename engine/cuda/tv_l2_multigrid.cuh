// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device.cuh"
#include "engine/cuda/tv_l2_steps.cuh"

#include <cstddef>
#include <vector>

/// Two ways to run a step: by the whole device, or by one block for each view, which waits for
/// itself between steps and so needs no launches for levels of few pixels.

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

/// The levels of a solver for `views` images of one size, and what differs from view to view.
class TvL2Grids {
 public:
  /// Throws DeviceFailure if there is too little memory.
  TvL2Grids(int height, int width, int views, const DeviceStream& stream);

  /// Bytes that one view takes.
  [[nodiscard]] static std::size_t bytes_per_view(int height, int width);

  [[nodiscard]] const TvL2Levels& levels() const { return levels_; }
  void swap_moved(int k) { levels_.level[k].swap_moved(); }
  [[nodiscard]] int views() const { return view_count_; }
  [[nodiscard]] TvL2View* of_views() { return views_.data(); }
  /// Copies what differs from view to view to the device.
  void set_views(const std::vector<TvL2View>& views, const DeviceStream& stream);

 private:
  int view_count_;
  TvL2Levels levels_;
  DeviceArray<float> memory_;
  DeviceArray<TvL2View> views_;
};

/// Sums over the pixels of every view, `[view][chunk][which]`: always added in the same order.
inline constexpr int kTvL2Sums = 3;
inline constexpr int kTvL2ChunkRows = 8;
[[nodiscard]] inline int chunks_of(const TvL2Level& level) {
  return (level.height + kTvL2ChunkRows - 1) / kTvL2ChunkRows;
}

/// Σ c, Σ c·f, Σ c·f².
void sum_moments(const DeviceStream& stream, const TvL2Level& level, int views, double* sums);
/// P(u), D(p), and nothing.
void sum_energies(const DeviceStream& stream, const TvL2Level& level, int views, double* sums);

/// Multigrid, down: smooths `level` from 0 and restricts the residual to `coarse`. u is not stored.
void descend_level(const DeviceStream& stream, const TvL2Level& level, const TvL2Level& coarse,
                   int views, const TvL2View* of_views);

/// Multigrid, up: u of `level` after the correction by `coarse`.
void ascend_level(const DeviceStream& stream, const TvL2Level& level, const TvL2Level& coarse,
                  int views, const TvL2View* of_views);

/// The levels of few pixels, from `first` on: a block for each view goes through all of them.
struct TvL2Tail {
  TvL2Levels levels;
  int first = 1;
  int views = 0;
  TvL2View* of_views = nullptr;
};

/// Whether the levels from `first` on are few enough pixels for that.
[[nodiscard]] bool fits_in_tail(const TvL2Levels& levels, int first);
/// Solves the levels of the tail, coarse to fine; z of the first is projected at the end.
void climb_tail(const DeviceStream& stream, const TvL2Tail& tail, int iterations,
                int penalty_every);
/// Penalties and diagonals of the tail, from the level before, for a solution of `stage`.
void renew_tail(const DeviceStream& stream, const TvL2Tail& tail, int stage);
/// The multigrid correction u of the tail's first level, from its b.
void correct_tail(const DeviceStream& stream, const TvL2Tail& tail, int stage);

}  // namespace episcope::cuda
