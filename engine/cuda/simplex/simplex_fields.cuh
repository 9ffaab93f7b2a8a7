// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device/device_array.cuh"

#include <cstddef>
#include <cstdint>

namespace episcope::cuda {

/// Pairs of neighbours of a pixel's cell: right, down, down-right, and its right with its lower
/// neighbour (engine/solvers/simplex/pair_duals.h).
inline constexpr int kSimplexPairs = 4;
/// Of shared memory, what the columns of a block may take.
inline constexpr int kColumnBytes = 48 << 10;

/// Threads of a block that keeps `layers` floats of each of its pixels in shared memory.
[[nodiscard]] constexpr int column_threads(int layers) {
  return layers * 128 * 4 <= kColumnBytes ? 128 : layers * 64 * 4 <= kColumnBytes ? 64 : 32;
}

/// Several problems of one size, `[problem][y][layer][x]`, as SimplexProblem: borrowed.
struct SimplexFields {
  int problems = 0, height = 0, layers = 0, width = 0;
  float *cost = nullptr, *weights = nullptr;  ///< g, `[problem][y][x]`
  float *u = nullptr, *ahead = nullptr, *duals[kSimplexPairs] = {};
  float limit = 0;  ///< λ/2, the largest size of a dual where g and the pair's share are 1.
  float primal_step = 0, dual_step = 0;

  [[nodiscard]] __host__ __device__ long pixels() const {
    return static_cast<long>(height) * width;
  }
  [[nodiscard]] __host__ __device__ long row() const { return static_cast<long>(layers) * width; }
  /// Layer 0 of a pixel.
  [[nodiscard]] __host__ __device__ long unknown(int problem, int y, int x) const {
    return (static_cast<long>(problem) * height + y) * row() + x;
  }
  [[nodiscard]] __host__ __device__ long pixel(int problem, int y, int x) const {
    return (static_cast<long>(problem) * height + y) * width + x;
  }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(problems) * static_cast<std::size_t>(height) *
           static_cast<std::size_t>(row());
  }
};

/// The largest size of the duals of the pairs that begin at a pixel, as PairLimits; 0 outside.
struct SimplexLimits {
  float of[kSimplexPairs];

  __device__ SimplexLimits(const SimplexFields& fields, int problem, int y, int x) {
    constexpr float kSide = 1.41421356F - 1.0F, kDiagonal = 1.0F - 0.70710678F;
    const bool inside = y >= 0 && x >= 0;
    const bool down = y + 1 < fields.height, right = x + 1 < fields.width;
    const float here = inside ? fields.limit * fields.weights[fields.pixel(problem, y, x)] : 0.0F;
    const float along = kSide + kDiagonal * static_cast<float>((y == 0 ? 1 : 0) + (down ? 0 : 1));
    const float aside = kSide + kDiagonal * static_cast<float>((x == 0 ? 1 : 0) + (right ? 0 : 1));
    of[0] = right ? here * along : 0;
    of[1] = down ? here * aside : 0;
    of[2] = of[3] = right && down ? here * kDiagonal : 0;
  }
};

/// Which problems are solved already, a bit each.
using SolvedMask = std::uint64_t;
inline constexpr int kMostProblems = 64;

}  // namespace episcope::cuda
