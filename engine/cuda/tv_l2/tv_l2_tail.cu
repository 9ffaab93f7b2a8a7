// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/tv_l2/tv_l2_penalty.cuh"
#include "engine/cuda/tv_l2/tv_l2_run.cuh"
#include "engine/cuda/tv_l2/tv_l2_tail.cuh"

#include <cuda_pipeline.h>

#include <algorithm>
#include <bit>

namespace episcope::cuda {
namespace {

constexpr int kTailWarps = 16, kTailThreads = 32 * kTailWarps;
// The largest side of a level that a block is quick with.
constexpr int kTailSide = 64;
// Before and after a plane in shared memory.
constexpr int kMargin = 4;

// Sets of planes: all, and those that a correction needs.
using Planes = unsigned;
constexpr Planes kAllPlanes = (1U << kTvL2Planes) - 1;
constexpr Planes set_of(TvL2Plane which) {
  return 1U << static_cast<int>(which);
}
constexpr Planes kCorrectionPlanes = set_of(TvL2Plane::C) | set_of(TvL2Plane::U) |
                                     set_of(TvL2Plane::Rx) | set_of(TvL2Plane::Ry) |
                                     set_of(TvL2Plane::Inverse) | set_of(TvL2Plane::B);

// Floats of a plane with the padding around it, and of one in shared memory.
__host__ __device__ int padded_size(const TvL2Level& level) {
  return (level.height + 2) * static_cast<int>(level.pitch);
}
__host__ __device__ int plane_size(const TvL2Level& level) {
  return padded_size(level) + 2 * kMargin;
}

std::size_t shared_bytes(const TvL2Levels& levels, int first, Planes planes) {
  std::size_t floats = 0;
  for (int k = first; k < levels.count; ++k) floats += plane_size(levels.level[k]);
  return floats * std::popcount(planes) * sizeof(float);
}

// The tail of one view in shared memory, where a step takes a fraction of the time.
class SharedTail {
 public:
  __device__ SharedTail(const TvL2Tail& tail, int view, Planes planes, float* memory,
                        TvL2Levels& levels)
      : tail_(tail), view_(view), levels_(levels) {
    place(planes, memory);
    __syncthreads();
    load(planes);
    __pipeline_commit();
    __pipeline_wait_prior(0);
    __syncthreads();
  }
  [[nodiscard]] __device__ const TvL2Levels& levels() const { return levels_; }
  // Brings a plane of the first level back.
  __device__ void store(TvL2Plane which) const {
    const TvL2Level& level = tail_.levels.level[tail_.first];
    float* const to = level.of(which, view_) - level.pitch;
    const float* const from = levels_.level[tail_.first].of(which, 0) - level.pitch;
    for (int i = static_cast<int>(threadIdx.x); i < padded_size(level); i += kTailThreads) {
      to[i] = from[i];
    }
  }

 private:
  // Each of the first threads a plane of a level.
  __device__ void place(Planes planes, float* memory) {
    constexpr int kEach = 16;
    static_assert(kTvL2Planes < kEach && kMaxTvL2Levels * kEach <= kTailThreads);
    const int k = tail_.first + static_cast<int>(threadIdx.x) / kEach;
    const int which = static_cast<int>(threadIdx.x) % kEach;
    if (threadIdx.x == 0) levels_.count = tail_.levels.count;
    if (k >= tail_.levels.count || which > kTvL2Planes) return;
    const TvL2Level& from = tail_.levels.level[k];
    TvL2Level& to = levels_.level[k];
    if (which == kTvL2Planes) {
      to.view = 0;
      to.height = from.height;
      to.width = from.width;
      to.pitch = from.pitch;
      to.odd = from.odd;
      return;
    }
    int at = kMargin + static_cast<int>(from.pitch);
    for (int i = tail_.first; i < k; ++i) at += __popc(planes) * plane_size(tail_.levels.level[i]);
    at += __popc(planes & ((1U << which) - 1)) * plane_size(from);
    to.planes[which] = memory + at;
  }
  // Each warp some planes. Pitches are multiples of four, and so are margins.
  __device__ void load(Planes planes) {
    int number = 0;
    for (int k = tail_.first; k < tail_.levels.count; ++k) {
      for (Planes left = planes; left != 0; left &= left - 1) {
        if (number++ % kTailWarps != static_cast<int>(threadIdx.x) / 32) continue;
        const auto which = static_cast<TvL2Plane>(__ffs(static_cast<int>(left)) - 1);
        const TvL2Level& level = tail_.levels.level[k];
        const float* const from = level.of(which, view_) - level.pitch;
        float* const to = levels_.level[k].of(which, 0) - level.pitch;
        const int lane = static_cast<int>(threadIdx.x) % 32;
        for (int i = 4 * lane; i < padded_size(level); i += 4 * 32) {
          __pipeline_memcpy_async(to + i, from + i, 4 * sizeof(float));
        }
      }
    }
  }

  const TvL2Tail& tail_;
  int view_;
  TvL2Levels& levels_;
};

// Level k as it serves while `stage` is solved: a multigrid cell weighs as much as its pixels
// together; CoarsenProblem halves that.
__device__ TvL2Level level_of(const TvL2Levels& levels, int k, int stage) {
  TvL2Level level = levels.level[k];
  level.data_scale = static_cast<float>(1 << (k - stage));
  return level;
}

__device__ void coarsen_penalties(const TvL2Levels& levels, const TvL2View* of_views, int view,
                                  int stage, int begin) {
  for (int k = begin; k < levels.count; ++k) {
    const TvL2Level fine = level_of(levels, k - 1, stage), coarse = level_of(levels, k, stage);
    run_in_block(CoarsenPenalty{fine, coarse, of_views}, cells_of(coarse), view);
    run_in_block(InvertDiagonal{coarse}, extent_of(coarse), view);
  }
}

// From b of level `begin` to its u.
__device__ void correct(const TvL2Levels& levels, int view, int stage, int begin) {
  const int last = levels.count - 1;
  for (int k = begin; k < last; ++k) {
    const TvL2Level fine = level_of(levels, k, stage), coarse = level_of(levels, k + 1, stage);
    run_in_block(RelaxFromZero{fine}, extent_of(fine), view);
    run_in_block(RelaxColour{fine, 1}, extent_of(fine), view);
    run_in_block(Restrict{fine, coarse}, cells_of(coarse), view);
  }
  // The last level is a single pixel, of colour 0.
  run_in_block(RelaxFromZero{level_of(levels, last, stage)}, {1, 1}, view);
  for (int k = last; --k >= begin;) {
    const TvL2Level fine = level_of(levels, k, stage), coarse = level_of(levels, k + 1, stage);
    run_in_block(CorrectAndRelax{fine, coarse}, extent_of(fine), view);
    run_in_block(RelaxColour{fine, 0}, extent_of(fine), view);
  }
}

__device__ void iterate(const TvL2Levels& levels, const TvL2View* of_views, int view, int stage,
                        int iteration, int penalty_every) {
  const TvL2Level level = level_of(levels, stage, stage);
  const TvL2Level coarse = level_of(levels, stage + 1, stage);
  if (iteration % penalty_every == 0) {
    run_in_block(Penalise{level, of_views, iteration == 0}, extent_of(level), view);
    run_in_block(InvertDiagonal{level}, extent_of(level), view);
    coarsen_penalties(levels, of_views, view, stage, stage + 1);
  }
  if (iteration > 0) {
    correct(levels, view, stage, stage + 1);
    run_in_block(CorrectAndRelax{level, coarse}, extent_of(level), view);
    run_in_block(RelaxColour{level, 0}, extent_of(level), view);
  }
  run_in_block(MoveDual{level, of_views}, extent_of(level), view);
  run_in_block(RenewAndRelax{level}, extent_of(level), view);
  run_in_block(RelaxColour{level, 1}, extent_of(level), view);
  run_in_block(Restrict{level, coarse}, cells_of(coarse), view);
}

__global__ void __launch_bounds__(kTailThreads)
    climb(const __grid_constant__ TvL2Tail tail, int iterations, int penalty_every) {
  extern __shared__ __align__(16) float memory[];
  __shared__ TvL2Levels placed;
  const int view = static_cast<int>(blockIdx.x);
  int stage = tail.levels.count - 2;
  if (stage < tail.first) return;
  const SharedTail shared(tail, view, kAllPlanes, memory, placed);
  const TvL2Levels& levels = shared.levels();
  run_in_block(StartFromData{levels.level[stage]}, extent_of(levels.level[stage]), view);
  for (;; --stage) {
    for (int i = 0; i < iterations; ++i) {
      iterate(levels, tail.of_views, view, stage, i, penalty_every);
    }
    const TvL2Level level = levels.level[stage];
    run_in_block(Project{level}, extent_of(level), view);
    if (stage == tail.first) break;
    const TvL2Level fine = levels.level[stage - 1];
    run_in_block(Prolong{level, fine}, extent_of(fine), view);
    run_in_block(Project{fine}, extent_of(fine), view);
  }
  for (const TvL2Plane which : {TvL2Plane::U, TvL2Plane::Zx, TvL2Plane::Zy}) shared.store(which);
}

__global__ void __launch_bounds__(kTailThreads)
    renew(const __grid_constant__ TvL2Tail tail, int stage) {
  const int view = static_cast<int>(blockIdx.x);
  if (tail.of_views[view].is_active == 0) return;
  coarsen_penalties(tail.levels, tail.of_views, view, stage, tail.first);
}

__global__ void __launch_bounds__(kTailThreads)
    correct_all(const __grid_constant__ TvL2Tail tail, int stage) {
  extern __shared__ __align__(16) float memory[];
  __shared__ TvL2Levels placed;
  const int view = static_cast<int>(blockIdx.x);
  if (tail.of_views[view].is_active == 0) return;
  const SharedTail shared(tail, view, kCorrectionPlanes, memory, placed);
  correct(shared.levels(), view, stage, tail.first);
  shared.store(TvL2Plane::U);
}

template <class Kernel>
int allow_shared(Kernel kernel, const TvL2Tail& tail, Planes planes) {
  const auto bytes = static_cast<int>(shared_bytes(tail.levels, tail.first, planes));
  check(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, bytes));
  return bytes;
}

}  // namespace

bool fits_in_tail(const TvL2Levels& levels, int first) {
  const TvL2Level& level = levels.level[first];
  if (std::max(level.height, level.width) > kTailSide) return false;
  constexpr int kStaticBytes = sizeof(TvL2Levels) + 128;
  int device = 0, most = 0;
  check(cudaGetDevice(&device));
  check(cudaDeviceGetAttribute(&most, cudaDevAttrMaxSharedMemoryPerBlockOptin, device));
  return shared_bytes(levels, first, kAllPlanes) + kStaticBytes <= static_cast<std::size_t>(most);
}

void climb_tail(const DeviceStream& stream, const TvL2Tail& tail, int iterations,
                int penalty_every) {
  const int bytes = allow_shared(climb, tail, kAllPlanes);
  launch(stream, {"tv_l2: small levels, climb"}, [&] {
    climb<<<tail.views, kTailThreads, bytes, stream.get()>>>(tail, iterations, penalty_every);
  });
}

void renew_tail(const DeviceStream& stream, const TvL2Tail& tail, int stage) {
  launch(stream, {"tv_l2: small levels, penalty"},
         [&] { renew<<<tail.views, kTailThreads, 0, stream.get()>>>(tail, stage); });
}

void correct_tail(const DeviceStream& stream, const TvL2Tail& tail, int stage) {
  const int bytes = allow_shared(correct_all, tail, kCorrectionPlanes);
  launch(stream, {"tv_l2: small levels, correction"},
         [&] { correct_all<<<tail.views, kTailThreads, bytes, stream.get()>>>(tail, stage); });
}

}  // namespace episcope::cuda
