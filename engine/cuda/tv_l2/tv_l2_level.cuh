// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device/device_array.cuh"

#include <cstdint>
#include <utility>

namespace episcope::cuda {

/// What a level of the solver holds for every pixel; as in engine/solvers/tv_l2/tv_l2_kernel.h.
enum class TvL2Plane { Cf, C, G, U, Zx, Zy, Rx, Ry, Inverse, B };
inline constexpr int kTvL2Planes = 10;
/// Those that an iteration moves have a second plane, which it writes to.
inline constexpr TvL2Plane kTvL2Moved[] = {TvL2Plane::U, TvL2Plane::Zx, TvL2Plane::Zy,
                                           TvL2Plane::B};
inline constexpr int kTvL2Slots = kTvL2Planes + 4;

/// One level of the grid hierarchy for all views, `[plane][view][row][half][i]`. Rows are split:
/// first the pixels of the even columns, `odd` floats further those of the odd ones, so that the
/// pixels of either colour of a chequerboard, and their neighbours, are contiguous. One row of
/// padding above and two below, padding after each half row; it is 0, and stays so because the
/// coefficients there are 0.
struct TvL2Level {
  /// Pixel (0, 0) of the first view in each plane; the last four are the second planes of those
  /// that are moved.
  float* planes[kTvL2Slots] = {};
  long view = 0;  ///< Floats from view to view.
  int height = 0, width = 0;
  long pitch = 0, odd = 0;
  float data_scale = 1;  ///< Factor of c when the level serves as multigrid level.

  /// Pixel (0, 0) of a view.
  [[nodiscard]] __device__ float* of(TvL2Plane which, int v) const {
    return planes[static_cast<int>(which)] + v * view;
  }
  /// The second plane of kTvL2Moved[moved].
  [[nodiscard]] __device__ float* second(int moved, int v) const {
    return planes[kTvL2Planes + moved] + v * view;
  }
  /// The second planes take the place of the first.
  void swap_moved() {
    for (int i = 0; i < kTvL2Slots - kTvL2Planes; ++i) {
      std::swap(planes[static_cast<int>(kTvL2Moved[i])], planes[kTvL2Planes + i]);
    }
  }
  [[nodiscard]] __host__ __device__ long at(int y, int x) const {
    return y * pitch + (x & 1) * odd + (x >> 1);
  }
  /// Pixels of the longer half of a row.
  [[nodiscard]] __host__ __device__ int half() const { return (width + 1) / 2; }
};

/// The pixels of one colour of row y, x + y + colour even: one half of it. Their neighbours to the
/// left and right are the other half, from `left` and from one float further.
struct ColourRow {
  long own = 0;
  long left = 0;
};

__device__ inline ColourRow colour_row(const TvL2Level& level, int y, int colour) {
  const long even = y * level.pitch;
  if (((y + colour) & 1) == 0) return {even, even + level.odd - 1};
  return {even + level.odd, even};
}

/// What differs from view to view, on the device.
struct TvL2View {
  std::uint8_t is_active = 1;  ///< 0 = done: nothing is changed any more.
  float offset = 0;            ///< Weighted mean of f, taken off for the sake of float.
  float scale = 1, knee = 1;   ///< Of the penalty.
  float coarse_edge = 0.75F;   ///< Factor of the edges of multigrid levels,
  float relaxation = 1.7F;     ///< and ADMM's: the pace.
};

/// The levels of a solver by value, for kernels.
inline constexpr int kMaxTvL2Levels = 16;
struct TvL2Levels {
  TvL2Level level[kMaxTvL2Levels];
  int count = 0;
};

}  // namespace episcope::cuda
