// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/tv_l2/tv_l2_penalty.cuh"
#include "engine/cuda/tv_l2/tv_l2_sums.cuh"

namespace episcope::cuda {
namespace {

constexpr int kThreads = 256;

struct Sums {
  double values[kTvL2Sums] = {};
};

// Adds up what the threads of a block have, by halves.
__device__ void store_sum(const Sums& own, double* sums) {
  __shared__ double shared[kTvL2Sums][kThreads];
  for (int k = 0; k < kTvL2Sums; ++k) shared[k][threadIdx.x] = own.values[k];
  __syncthreads();
  for (int half = kThreads / 2; half > 0; half /= 2) {
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
    for (int x = static_cast<int>(threadIdx.x); x < each.level.width; x += kThreads) {
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
         [&] { sum_chunks<<<grid, kThreads, 0, stream.get()>>>(each, sums); });
}

}  // namespace

void sum_moments(const DeviceStream& stream, const TvL2Level& level, int views, double* sums) {
  sum_all(stream, "tv_l2: moments", Moments{level}, views, 2, sums);
}

void sum_energies(const DeviceStream& stream, const TvL2Level& level, int views, double* sums) {
  sum_all(stream, "tv_l2: energies", Energies{level}, views, 8, sums);
}

}  // namespace episcope::cuda
