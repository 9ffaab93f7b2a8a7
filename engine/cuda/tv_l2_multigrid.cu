// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/tv_l2_multigrid.cuh"

#include "engine/core/numbers.h"
#include "engine/cuda/device.cuh"
#include "engine/cuda/tv_l2_iteration.cuh"
#include "engine/cuda/tv_l2_steps.cuh"

#include <cuda_pipeline.h>

#include <algorithm>
#include <bit>

namespace episcope::cuda {
namespace {

// Before the first pixel of a plane, besides a row, and behind the last.
constexpr long kGridMargin = 32;

long grid_plane_size(const TvL2Level& level, int views) {
  return views * level.view + 2 * kGridMargin;
}

// Level by level down to a single pixel, at least two.
TvL2Levels make_levels(int height, int width) {
  TvL2Levels levels;
  for (;;) {
    TvL2Level& level = levels.level[levels.count++];
    level.height = height;
    level.width = width;
    const int unit = level.half() >= 64 ? 32 : 4;
    level.odd = round_up(level.half() + 1, unit);
    level.pitch = 2 * level.odd;
    level.view = (height + 2) * level.pitch;
    if (std::max(height, width) == 1 && levels.count >= 2) return levels;
    height = (height + 1) / 2;
    width = (width + 1) / 2;
  }
}

std::size_t floats_of(const TvL2Levels& levels, int views) {
  long floats = 0;
  for (int k = 0; k < levels.count; ++k)
    floats += kTvL2Slots * grid_plane_size(levels.level[k], views);
  return static_cast<std::size_t>(floats);
}

}  // namespace

TvL2Grids::TvL2Grids(int height, int width, int views, const DeviceStream& stream)
    : view_count_(views),
      levels_(make_levels(height, width)),
      memory_(floats_of(levels_, views), stream),
      views_(static_cast<std::size_t>(views), stream) {
  memory_.clear();
  float* next = memory_.data();
  for (int k = 0; k < levels_.count; ++k) {
    TvL2Level& level = levels_.level[k];
    for (float*& plane : level.planes) {
      plane = next + kGridMargin + level.pitch;
      next += grid_plane_size(level, views);
    }
  }
}

std::size_t TvL2Grids::bytes_per_view(int height, int width) {
  return floats_of(make_levels(height, width), 1) * sizeof(float);
}

void TvL2Grids::set_views(const std::vector<TvL2View>& views, const DeviceStream& stream) {
  check(cudaMemcpyAsync(views_.data(), views.data(), views.size() * sizeof(TvL2View),
                        cudaMemcpyHostToDevice, stream.get()));
}

namespace {

constexpr int kSumThreads = 256;

struct Sums {
  double values[kTvL2Sums] = {};
};

// Adds up what the threads of a block have, by halves.
__device__ void store_sum(const Sums& own, double* sums) {
  __shared__ double shared[kTvL2Sums][kSumThreads];
  for (int k = 0; k < kTvL2Sums; ++k) shared[k][threadIdx.x] = own.values[k];
  __syncthreads();
  for (int half = kSumThreads / 2; half > 0; half /= 2) {
    if (static_cast<int>(threadIdx.x) < half) {
      for (int k = 0; k < kTvL2Sums; ++k) shared[k][threadIdx.x] += shared[k][threadIdx.x + half];
    }
    __syncthreads();
  }
  if (threadIdx.x != 0) return;
  double* const to = sums + (static_cast<long>(blockIdx.y) * gridDim.x + blockIdx.x) * kTvL2Sums;
  for (int k = 0; k < kTvL2Sums; ++k) to[k] = shared[k][0];
}

struct Moments {
  TvL2Level level;

  __device__ void operator()(int view, int y, int x, Sums& sums) const {
    const long at = level.at(y, x);
    const double c = level.of(TvL2Plane::C, view)[at], cf = level.of(TvL2Plane::Cf, view)[at];
    sums.values[0] += c;
    sums.values[1] += cf;
    sums.values[2] += cf * cf / c;
  }
};

// P(u) and D(p) with p the projection of z.
struct Energies {
  TvL2Level level;

  struct Dual {
    float x = 0, y = 0;
  };
  __device__ Dual dual(int view, long at) const {
    const float zx = level.of(TvL2Plane::Zx, view)[at], zy = level.of(TvL2Plane::Zy, view)[at];
    const float keep = shrinkage(zx, zy, level.of(TvL2Plane::G, view)[at]);
    return {zx * keep, zy * keep};
  }
  __device__ void operator()(int view, int y, int x, Sums& sums) const {
    const long at = level.at(y, x);
    const bool is_odd = (x & 1) != 0;
    const long right = is_odd ? at - level.odd + 1 : at + level.odd;
    const long left = is_odd ? at - level.odd : at + level.odd - 1;
    const TvL2Gradient gradient = gradient_at(level, view, at, right);
    const float c = level.of(TvL2Plane::C, view)[at], cf = level.of(TvL2Plane::Cf, view)[at];
    const float off = level.of(TvL2Plane::U, view)[at] - cf / c;
    const float variation = sqrtf(gradient.x * gradient.x + gradient.y * gradient.y);
    sums.values[0] += level.of(TvL2Plane::G, view)[at] * variation + 0.5F * c * off * off;
    const Dual here = dual(view, at);
    const float divergence = here.x - dual(view, left).x + here.y - dual(view, at - level.pitch).y;
    sums.values[1] -= divergence * (cf + 0.5F * divergence) / c;
  }
};

template <class Each>
__global__ void sum_chunks(Each each, double* sums) {
  Sums own;
  const int first = static_cast<int>(blockIdx.x) * kTvL2ChunkRows;
  const int end = min(first + kTvL2ChunkRows, each.level.height);
  for (int y = first; y < end; ++y) {
    for (int x = static_cast<int>(threadIdx.x); x < each.level.width; x += kSumThreads) {
      each(static_cast<int>(blockIdx.y), y, x, own);
    }
  }
  store_sum(own, sums);
}

template <class Each>
void sum_all(const DeviceStream& stream, const char* name, const Each& each, int views,
             double floats, double* sums) {
  const double pixels = static_cast<double>(each.level.height) * each.level.width * views;
  const dim3 grid(static_cast<unsigned>(chunks_of(each.level)), static_cast<unsigned>(views));
  launch(stream, {name, pixels * floats * sizeof(float), pixels * 20},
         [&] { sum_chunks<<<grid, kSumThreads, 0, stream.get()>>>(each, sums); });
}

}  // namespace

void sum_moments(const DeviceStream& stream, const TvL2Level& level, int views, double* sums) {
  sum_all(stream, "tv_l2: moments", Moments{level}, views, 2, sums);
}

void sum_energies(const DeviceStream& stream, const TvL2Level& level, int views, double* sums) {
  sum_all(stream, "tv_l2: energies", Energies{level}, views, 8, sums);
}

namespace {

// Multigrid, down and up one level: the steps of tv_l2_steps.cuh on tiles in shared memory.

// The last step of a tile needs two pixels around it.
using Shape = TvL2TileShape<32, 16, 1, 2, 352>;
constexpr int kThreads = Shape::kThreads, kEach = Shape::kEach;
constexpr int kOdd = Shape::kOdd, kRow = Shape::kRow, kPlane = Shape::kPlane;

struct Shared {
  float u[kPlane], rx[kPlane], ry[kPlane], residual[kPlane];
};

// Where one of a thread's places lies, two pixels, found once; arrays are by color.
struct Place {
  int at[2] = {0, 0};    // in a plane of the tile
  int left[2] = {0, 0};  // of the pixel to the left there; that to the right is the next one
  int from[2] = {0, 0};  // in a plane of a view
  int cell = 0;          // in a plane of the coarse level
  bool exists = false, is_inside = false, is_core = false;
  bool is_inner = false;   // the rows above and below belong to the tile
  bool is_even = false;    // its row
  bool has_below = false;  // in the level
};

__device__ Place place_of(const TvL2Level& level, const TvL2Level& coarse, int number) {
  const TvL2TilePlace place = Shape::place(level, number);
  Place result;
#pragma unroll
  for (int color = 0; color < 2; ++color) {
    const int half = (place.row + color) & 1;
    result.at[color] = place.y * kRow + half * kOdd + place.i;
    result.left[color] = place.y * kRow + (half == 0 ? kOdd - 1 : 0) + place.i;
    result.from[color] = place.row * static_cast<int>(level.pitch) +
                         half * static_cast<int>(level.odd) + place.place;
  }
  result.cell = static_cast<int>(coarse.at(place.row >> 1, place.place));
  result.exists = place.exists;
  result.is_inside = place.is_inside;
  result.is_core =
      place.is_inside && Shape::rows_beside(place) == 0 && Shape::pixels_beside(place) == 0;
  result.is_inner = place.exists && place.y > 0 && place.y + 1 < Shape::kRows;
  result.is_even = (place.row & 1) == 0;
  result.has_below = place.row + 1 < level.height;
  return result;
}

class Tile {
 public:
  __device__ Tile(const TvL2Level& level, const TvL2Level& coarse, int view, Shared& shared)
      : level_(level), coarse_(coarse), view_(view), shared_(shared) {
#pragma unroll
    for (int k = 0; k < kEach; ++k) places_[k] = place_of(level, coarse, k);
  }

  // Reads the tile and relaxes color 0 from 0; color 1 begins at 0.
  __device__ void load();
  // Adds the correction of the coarse cells to color 0.
  __device__ void correct();
  __device__ void relax(int color);
  __device__ void restrict_residual();
  __device__ void store() const;

 private:
  // What no block writes meanwhile.
  [[nodiscard]] __device__ float read(TvL2Plane which, const Place& place, int color) const {
    return place.is_inside ? __ldg(level_.of(which, view_) + place.from[color]) : 0.0F;
  }
  // Σ penalty·(neighbor − here).
  [[nodiscard]] __device__ float pull(const Place& place, int color, float here) const {
    const int at = place.at[color], left = place.left[color];
    const float *const u = shared_.u, *const rx = shared_.rx, *const ry = shared_.ry;
    return rx[at] * (u[left + 1] - here) + rx[left] * (u[left] - here) +
           ry[at] * (u[at + kRow] - here) + ry[at - kRow] * (u[at - kRow] - here);
  }

  const TvL2Level &level_, &coarse_;
  int view_;
  Shared& shared_;
  Place places_[kEach];
  float b_[kEach][2], inverse_[kEach][2];  // of both colors
};

__device__ void Tile::load() {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (!place.exists) continue;
#pragma unroll
    for (int color = 0; color < 2; ++color) {
      const int at = place.at[color];
      shared_.rx[at] = read(TvL2Plane::Rx, place, color);
      shared_.ry[at] = read(TvL2Plane::Ry, place, color);
      b_[k][color] = read(TvL2Plane::B, place, color);
      inverse_[k][color] = read(TvL2Plane::Inverse, place, color);
      shared_.u[at] = color == 0 ? b_[k][0] * inverse_[k][0] : 0.0F;
    }
  }
  __syncthreads();
}

// Of its own pixels, which nobody else looks at before the next step.
__device__ void Tile::correct() {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (place.is_inside)
      shared_.u[place.at[0]] += __ldg(coarse_.of(TvL2Plane::U, view_) + place.cell);
  }
  __syncthreads();
}

__device__ void Tile::relax(int color) {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (!place.is_inner) continue;
    shared_.u[place.at[color]] = (b_[k][color] + pull(place, color, 0)) * inverse_[k][color];
  }
  __syncthreads();
}

// The residual of color 0 of cells of 2×2; color 1, relaxed last, has none.
__device__ void Tile::restrict_residual() {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (!place.is_core) continue;
    const float here = shared_.u[place.at[0]], c = read(TvL2Plane::C, place, 0);
    shared_.residual[place.at[0]] = b_[k][0] + pull(place, 0, here) - level_.data_scale * c * here;
  }
  __syncthreads();
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (!place.is_core || !place.is_even) continue;
    float sum = shared_.residual[place.at[0]];
    if (place.has_below) sum += shared_.residual[place.at[1] + kRow];
    coarse_.of(TvL2Plane::B, view_)[place.cell] = sum;
  }
}

__device__ void Tile::store() const {
#pragma unroll
  for (int k = 0; k < kEach; ++k) {
    const Place& place = places_[k];
    if (!place.is_core) continue;
#pragma unroll
    for (int color = 0; color < 2; ++color) {
      level_.of(TvL2Plane::U, view_)[place.from[color]] = shared_.u[place.at[color]];
    }
  }
}

enum class Way { Down, Up };

// On the way down nothing but color 0 is found that is needed on the way up, and that again from b
// alone.
template <Way kWay>
__global__ void __launch_bounds__(kThreads, 3)
    cycle_tiles(const __grid_constant__ TvL2Level level, const __grid_constant__ TvL2Level coarse,
                const TvL2View* views) {
  __shared__ Shared shared;
  const int view = static_cast<int>(blockIdx.z);
  if (views[view].is_active == 0) return;
  Tile tile(level, coarse, view, shared);
  tile.load();
  if constexpr (kWay == Way::Up) tile.correct();
  tile.relax(1);
  if constexpr (kWay == Way::Down) {
    tile.restrict_residual();
  } else {
    tile.relax(0);
    tile.store();
  }
}

template <Way kWay>
void run_tiles(const DeviceStream& stream, const TvL2Level& level, const TvL2Level& coarse,
               int views, const TvL2View* of_views) {
  const char* const name = kWay == Way::Down ? "tv_l2: descent" : "tv_l2: ascent";
  const double floats = kWay == Way::Down ? 9.5 : 10.5;
  const double places = static_cast<double>(level.height) * level.half() * views;
  launch(stream, {name, places * floats * sizeof(float), places * 40}, [&] {
    cycle_tiles<kWay>
        <<<Shape::blocks(level, views), kThreads, 0, stream.get()>>>(level, coarse, of_views);
  });
}

}  // namespace

void descend_level(const DeviceStream& stream, const TvL2Level& level, const TvL2Level& coarse,
                   int views, const TvL2View* of_views) {
  run_tiles<Way::Down>(stream, level, coarse, views, of_views);
}

void ascend_level(const DeviceStream& stream, const TvL2Level& level, const TvL2Level& coarse,
                  int views, const TvL2View* of_views) {
  run_tiles<Way::Up>(stream, level, coarse, views, of_views);
}

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
    run_in_block(RelaxColor{fine, 1}, extent_of(fine), view);
    run_in_block(Restrict{fine, coarse}, cells_of(coarse), view);
  }
  // The last level is a single pixel, of color 0.
  run_in_block(RelaxFromZero{level_of(levels, last, stage)}, {1, 1}, view);
  for (int k = last; --k >= begin;) {
    const TvL2Level fine = level_of(levels, k, stage), coarse = level_of(levels, k + 1, stage);
    run_in_block(CorrectAndRelax{fine, coarse}, extent_of(fine), view);
    run_in_block(RelaxColor{fine, 0}, extent_of(fine), view);
  }
}

__device__ void iterate(const TvL2Levels& levels, const TvL2View* of_views, int view, int stage,
                        int iteration, int penalty_every) {
  const TvL2Level level = level_of(levels, stage, stage);
  const TvL2Level coarse = level_of(levels, stage + 1, stage);
  if (iteration % penalty_every == 0) {
    run_in_block(Penalize{level, of_views, iteration == 0}, extent_of(level), view);
    run_in_block(InvertDiagonal{level}, extent_of(level), view);
    coarsen_penalties(levels, of_views, view, stage, stage + 1);
  }
  if (iteration > 0) {
    correct(levels, view, stage, stage + 1);
    run_in_block(CorrectAndRelax{level, coarse}, extent_of(level), view);
    run_in_block(RelaxColor{level, 0}, extent_of(level), view);
  }
  run_in_block(MoveDual{level, of_views}, extent_of(level), view);
  run_in_block(RenewAndRelax{level}, extent_of(level), view);
  run_in_block(RelaxColor{level, 1}, extent_of(level), view);
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
