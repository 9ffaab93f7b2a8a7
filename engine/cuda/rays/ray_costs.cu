// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/rays/ray_costs.cuh"

namespace episcope::cuda {
namespace {

constexpr int kThreads = 128;
constexpr int kProbabilities = 256;

// The first of the `near` places nearest to `here` of `count`, as many at the border.
__device__ int first_near(int here, int near, int count) {
  return max(min(here - near / 2, count - near), 0);
}

// Adds the costs of another view's ray, weighted by its trust, which it returns.
__device__ float add_ray(const ViewRays& rays, int view, int other, int y, int x,
                         const float* costs, float* sums, int stride) {
  const std::int32_t target = rays.target(view, other, y, x);
  if (target < 0) return 0;
  const float trust = rays.trust(view, y * rays.width + x, other, target);
  if (trust == 0) return 0;
  const std::uint8_t* const p =
      rays.probabilities +
      (static_cast<long>(other) * rays.height + target / rays.width) * rays.layers * rays.width +
      target % rays.width;
  for (int l = 0; l < rays.layers; ++l) {
    sums[l * stride] =
        __fadd_rn(sums[l * stride], __fmul_rn(trust, costs[p[static_cast<long>(l) * rays.width]]));
  }
  return trust;
}

__global__ void fill(ViewRays rays, ProblemViews views, int near, SimplexFields fields) {
  extern __shared__ float shared[];
  float* const costs = shared;
  const int stride = static_cast<int>(blockDim.x), thread = static_cast<int>(threadIdx.x);
  for (int i = thread; i < kProbabilities; i += stride) costs[i] = rays.costs[i];
  __syncthreads();
  float* const sums = shared + kProbabilities + thread;
  const int x = static_cast<int>(blockIdx.x) * stride + thread, y = static_cast<int>(blockIdx.y);
  const auto problem = static_cast<int>(blockIdx.z);
  if (x >= rays.width) return;
  const int view = views.view[problem];
  const std::uint8_t* const own =
      rays.probabilities + (static_cast<long>(view) * rays.height + y) * rays.layers * rays.width +
      x;
  for (int l = 0; l < rays.layers; ++l) {
    sums[l * stride] = costs[own[static_cast<long>(l) * rays.width]];
  }
  float weight = 1;
  const int v0 = first_near(view / rays.grid.u, near, rays.grid.v);
  const int u0 = first_near(view % rays.grid.u, near, rays.grid.u);
  for (int v = v0; v < min(v0 + near, rays.grid.v); ++v) {
    for (int u = u0; u < min(u0 + near, rays.grid.u); ++u) {
      const int other = v * rays.grid.u + u;
      if (other != view) weight += add_ray(rays, view, other, y, x, costs, sums, stride);
    }
  }
  float* const out = fields.cost + fields.unknown(problem, y, x);
  for (int l = 0; l < rays.layers; ++l) {
    out[static_cast<long>(l) * rays.width] = __fdiv_rn(sums[l * stride], weight);
  }
  const long pixel = static_cast<long>(view) * rays.pixels() + static_cast<long>(y) * rays.width;
  fields.weights[fields.pixel(problem, y, x)] =
      rays.weights != nullptr ? rays.weights[pixel + x] : 1.0F;
}

__global__ void find(ViewRays rays, ProblemViews views, std::int32_t* places) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const auto y = static_cast<int>(blockIdx.y), problem = static_cast<int>(blockIdx.z);
  if (x >= rays.width) return;
  places[problem * rays.pixels() + static_cast<long>(y) * rays.width + x] =
      rays.target(views.view[problem], views.last[problem], y, x);
}

dim3 blocks(const ViewRays& rays, const ProblemViews& views, int threads) {
  return dim3(blocks_for(rays.width, threads), static_cast<unsigned>(rays.height),
              static_cast<unsigned>(views.count));
}

}  // namespace

void fill_problems(const ViewRays& rays, const ProblemViews& views, int near,
                   const SimplexFields& fields, const DeviceStream& stream) {
  const int threads = column_threads(rays.layers);
  const double pixels = static_cast<double>(rays.pixels()) * views.count;
  const double others = near > 0 ? near * near - 1 : 0;
  const std::size_t shared =
      sizeof(float) * static_cast<std::size_t>(kProbabilities + rays.layers * threads);
  // Views that several problems look at are in the cache for all but the first.
  launch(stream,
         {"labels: costs of rays", pixels * (5.0 * rays.layers + 4),
          pixels * others * (2.0 * rays.layers + 20)},
         [&] {
           fill<<<blocks(rays, views, threads), static_cast<unsigned>(threads), shared,
                  stream.get()>>>(rays, views, near, fields);
         });
}

void find_places(const ViewRays& rays, const ProblemViews& views, std::int32_t* places,
                 const DeviceStream& stream) {
  const double pixels = static_cast<double>(rays.pixels()) * views.count;
  launch(stream, {"labels: places", 12 * pixels, 10 * pixels}, [&] {
    find<<<blocks(rays, views, kThreads), kThreads, 0, stream.get()>>>(rays, views, places);
  });
}

}  // namespace episcope::cuda
