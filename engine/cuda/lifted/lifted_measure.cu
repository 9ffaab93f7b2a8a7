// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/lifted/lifted_fields.cuh"

namespace episcope::cuda {
namespace {

constexpr int kThreads = 128;
__constant__ const float kThresholds[kLiftedThresholdCount] = {0.25F, 0.5F, 0.75F};

// Adds up what the threads of a block have, by halves, into its part.
__device__ void store_part(double own, double* parts) {
  __shared__ double shared[kThreads];
  shared[threadIdx.x] = own;
  __syncthreads();
  for (int half = kThreads / 2; half > 0; half /= 2) {
    if (static_cast<int>(threadIdx.x) < half) shared[threadIdx.x] += shared[threadIdx.x + half];
    __syncthreads();
  }
  if (threadIdx.x == 0) parts[static_cast<long>(blockIdx.y) * gridDim.x + blockIdx.x] = shared[0];
  __syncthreads();
}

// Duals of one pair at one pixel, projected to the limit.
struct Limited {
  const float* duals;
  float limit;

  __device__ Limited(const LiftedFields& fields, int pair, int y, int x)
      : duals(fields.duals[pair] + fields.unknown(max(y, 0), max(x, 0))),
        limit(y < 0 || x < 0 ? 0.0F : fields.limits[pair][fields.pixel(y, x)]) {}
  [[nodiscard]] __device__ float operator()(long i) const {
    return fmaxf(fminf(duals[i], limit), -limit);
  }
};

// min_k [ρ_k − Σ_{l ≤ k} div p_l] of a pixel.
__device__ float bound_at(const LiftedFields& fields, int y, int x) {
  const Limited right(fields, 0, y, x), left(fields, 0, y, x - 1);
  const Limited down(fields, 1, y, x), upper(fields, 1, y - 1, x);
  const Limited across(fields, 2, y, x), falling(fields, 2, y - 1, x - 1);
  const Limited rising(fields, 3, y, x - 1), above(fields, 3, y - 1, x);
  const float* const cost = fields.cost.data + fields.costs_of(y, x);
  float least = cost[0], gathered = 0;
#pragma unroll 2
  for (int l = 0; l < fields.steps; ++l) {
    const long i = static_cast<long>(l) * fields.width();
    gathered += right(i) - left(i) + (down(i) - upper(i)) + (across(i) - falling(i)) +
                (rising(i) - above(i));
    least = fminf(least, cost[i + fields.width()] - gathered);
  }
  return least;
}

// The labels at each threshold, and the bound.
__global__ void cut_and_bound(LiftedFields fields, double* bounds) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  double own = 0;
  if (x < fields.width()) {
    int labels[kLiftedThresholdCount] = {};
    const float* const phi = fields.phi + fields.unknown(y, x);
#pragma unroll 4
    for (int l = 0; l < fields.steps; ++l) {
      const float value = phi[static_cast<long>(l) * fields.width()];
#pragma unroll
      for (int k = 0; k < kLiftedThresholdCount; ++k) labels[k] += value >= kThresholds[k] ? 1 : 0;
    }
#pragma unroll
    for (int k = 0; k < kLiftedThresholdCount; ++k) {
      fields.cuts[k][fields.pixel(y, x)] = labels[k];
    }
    own = bound_at(fields, y, x);
  }
  store_part(own, bounds);
}

// The costs of a labeling's pixels and of the pairs that begin there.
__global__ void sum_energies(LiftedFields fields, double* sums) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  const int right = min(x + 1, fields.width() - 1), below = min(y + 1, fields.height() - 1);
  for (int k = 0; k < kLiftedThresholdCount; ++k) {
    double own = 0;
    if (x < fields.width()) {
      const int* const labels = fields.cuts[k];
      const long at = fields.pixel(y, x);
      const int here = labels[at], beside = labels[fields.pixel(y, right)];
      const int down = labels[fields.pixel(below, x)];
      const int across = labels[fields.pixel(below, right)];
      const auto pair = [&](int kind, int from, int to) {
        return static_cast<double>(fields.limits[kind][at]) * abs(to - from);
      };
      own = pair(0, here, beside) + pair(1, here, down) + pair(2, here, across) +
            pair(3, beside, down) +
            static_cast<double>(
                fields.cost.data[fields.costs_of(y, x) + static_cast<long>(here) * fields.width()]);
    }
    store_part(own, sums + static_cast<long>(k) * gridDim.x * gridDim.y);
  }
}

dim3 grid_of(const LiftedFields& fields) {
  return {blocks_for(fields.width(), kThreads), static_cast<unsigned>(fields.height())};
}

}  // namespace

int lifted_parts(const LiftedFields& fields) {
  return static_cast<int>(grid_of(fields).x) * fields.height();
}

void measure_bound(const LiftedFields& fields, double* parts, const DeviceStream& stream) {
  const auto values = static_cast<double>(fields.cost.size());
  launch(stream, {"lifted: bound", values * 24, values * 30},
         [&] { cut_and_bound<<<grid_of(fields), kThreads, 0, stream.get()>>>(fields, parts); });
}

void measure_energies(const LiftedFields& fields, double* parts, const DeviceStream& stream) {
  const double pixels = static_cast<double>(fields.height()) * fields.width();
  launch(stream, {"lifted: energies", pixels * 40, pixels * 30},
         [&] { sum_energies<<<grid_of(fields), kThreads, 0, stream.get()>>>(fields, parts); });
}

}  // namespace episcope::cuda
