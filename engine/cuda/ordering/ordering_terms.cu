// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/device_array.cuh"
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/ordering/ordering_terms.cuh"

namespace episcope::cuda {
namespace {

// Least and largest disparity, as integers of the same order: every line is found by looking no
// farther than these.
struct Bounds {
  int least, largest;
};

__device__ int ordered(float value) {
  const int bits = __float_as_int(value);
  return bits >= 0 ? bits : bits ^ 0x7FFFFFFF;
}
__device__ float unordered(int order) {
  return __int_as_float(order >= 0 ? order : order ^ 0x7FFFFFFF);
}

__global__ void begin_bounds(Bounds* bounds) {
  *bounds = {ordered(0.0F), ordered(0.0F)};
}

__global__ void find_bounds(const float* u, long count, Bounds* bounds) {
  __shared__ Bounds own;
  if (threadIdx.x == 0) own = {ordered(0.0F), ordered(0.0F)};
  __syncthreads();
  int least = ordered(0.0F), largest = least;
  const long stride = static_cast<long>(gridDim.x) * blockDim.x;
  for (long i = static_cast<long>(blockIdx.x) * blockDim.x + threadIdx.x; i < count; i += stride) {
    least = min(least, ordered(u[i]));
    largest = max(largest, ordered(u[i]));
  }
  atomicMin(&own.least, least);
  atomicMax(&own.largest, largest);
  __syncthreads();
  if (threadIdx.x != 0) return;
  atomicMin(&bounds->least, own.least);
  atomicMax(&bounds->largest, own.largest);
}

struct Pull {
  float curvature = 0, force = 0;
};

// Slope and curvature of the penalty.
struct Bend {
  DevicePenalty penalty;
  float stiffness;

  __device__ explicit Bend(const DevicePenalty& of)
      : penalty(of), stiffness(of.fall / of.softness) {}
  [[nodiscard]] __device__ float slope(float a) const {
    return fminf(fmaxf(a * stiffness, -penalty.fall), penalty.rise);
  }
  [[nodiscard]] __device__ float curvature(float a) const {
    const float size = fabsf(a);
    return size <= penalty.softness ? stiffness : penalty.fall / size;
  }
};

// Of the line that begins at a pixel.
__device__ void add_pull_on_from(const Bend& bend, const float* here, const float* there,
                                 const Along& along, int position, int last, float step,
                                 Pull& pull) {
  const float own = here[along.at(position)];
  const LineEnd end = line_end(position, step, own, last);
  if (end.tap < 0) return;
  const float a = line_difference(there, along, end, last, own);
  pull.curvature += bend.curvature(a);
  pull.force += bend.slope(a);
}

// Of the lines of a neighbour that end at a pixel, in the order of where they begin.
__device__ void add_pull_on_to(const Bend& bend, const float* here, const float* there,
                               const Along& along, int position, int last, float step, float least,
                               float largest, Pull& pull) {
  // Lines begin at position − step·slope, within a pixel.
  const float low = step > 0 ? -largest : least, high = step > 0 ? -least : largest;
  const int first = max(position + static_cast<int>(floorf(low)) - 1, 0);
  const int end = min(position + static_cast<int>(ceilf(high)) + 1, last);
  for (int from = first; from <= end; ++from) {
    const float slope = there[along.at(from)];
    const LineEnd at = line_end(from, step, slope, last);
    if (at.tap < 0) continue;
    const int second = min(at.tap + 1, last);
    if (at.tap != position && second != position) continue;
    const float a = line_difference(here, along, at, last, slope);
    float share = at.tap == position ? 1 - at.weight : 0.0F;
    if (second == position) share += at.weight;
    pull.curvature += share * bend.curvature(a);
    pull.force -= share * bend.slope(a);
  }
}

__global__ void majorise_views(OrderedViews views, DevicePenalty penalty, const Bounds* bounds,
                               OrderedProblem problem) {
  const OrderedMaps& maps = views.maps;
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
  if (x >= maps.width || y >= maps.height) return;
  const int number = views.numbers[blockIdx.z];
  const int v = number / maps.grid.u, u = number % maps.grid.u;
  const float* const here = views.u + number * maps.pixels();
  const Bend bend(penalty);
  const float least = unordered(bounds->least), largest = unordered(bounds->largest);
  Pull pull;
  for (int i = 0; i < kWays; ++i) {
    const Way way = way_of(i);
    const int other_v = v + way.v, other_u = u + way.u;
    if (other_v < 0 || other_v >= maps.grid.v || other_u < 0 || other_u >= maps.grid.u) continue;
    const int other = other_v * maps.grid.u + other_u;
    if (views.counts[other] == 0) continue;
    const float* const there = views.u + other * maps.pixels();
    const Along along{way.is_vertical(), y, x, maps.width};
    const int position = way.is_vertical() ? y : x;
    const int last = (way.is_vertical() ? maps.height : maps.width) - 1;
    add_pull_on_from(bend, here, there, along, position, last, way.step(), pull);
    add_pull_on_to(bend, here, there, along, position, last, -way.step(), least, largest, pull);
  }
  const long at = static_cast<long>(y) * maps.width + x;
  const long from = number * maps.pixels() + at, to = blockIdx.z * maps.pixels() + at;
  const float w = views.weights[from], sum = w + pull.curvature;
  problem.f[to] = (w * views.observed[from] + pull.curvature * here[at] + pull.force) / sum;
  problem.w[to] = sum;
  problem.g[to] = views.edges[from];
}

__global__ void count_all(OrderedMaps maps, const float* u, float limit,
                          unsigned long long* counts) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
  __shared__ unsigned own[2];
  if (threadIdx.x + threadIdx.y == 0) own[0] = own[1] = 0;
  __syncthreads();
  const int number = static_cast<int>(blockIdx.z);
  const int view_v = number / maps.grid.u, view_u = number % maps.grid.u;
  const bool is_inside = x < maps.width && y < maps.height;
  for (int i = 0; is_inside && i < kWays; ++i) {
    const Way way = way_of(i);
    const int other_v = view_v + way.v, other_u = view_u + way.u;
    if (other_v < 0 || other_v >= maps.grid.v || other_u < 0 || other_u >= maps.grid.u) continue;
    const Along along{way.is_vertical(), y, x, maps.width};
    const int position = way.is_vertical() ? y : x;
    const int last = (way.is_vertical() ? maps.height : maps.width) - 1;
    const float from = u[number * maps.pixels() + along.at(position)];
    const LineEnd end = line_end(position, way.step(), from, last);
    if (end.tap < 0) continue;
    const float* const there = u + (other_v * maps.grid.u + other_u) * maps.pixels();
    atomicAdd(&own[1], 1U);
    if (line_difference(there, along, end, last, from) < limit) atomicAdd(&own[0], 1U);
  }
  __syncthreads();
  if (threadIdx.x + threadIdx.y != 0) return;
  atomicAdd(&counts[0], static_cast<unsigned long long>(own[0]));
  atomicAdd(&counts[1], static_cast<unsigned long long>(own[1]));
}

dim3 blocks_of(const OrderedMaps& maps, int views) {
  return {blocks_for(maps.width, 32), blocks_for(maps.height, 8), static_cast<unsigned>(views)};
}

}  // namespace

void majorise(const OrderedViews& views, const DevicePenalty& penalty,
              const OrderedProblem& problem, const DeviceStream& stream) {
  DeviceArray<Bounds> bounds(1, stream);
  const long all = views.maps.grid.count() * views.maps.pixels();
  launch(stream, {"ordering: begin"},
         [&] { begin_bounds<<<1, 1, 0, stream.get()>>>(bounds.data()); });
  launch(stream, {"ordering: bounds", 4.0 * static_cast<double>(all)},
         [&] { find_bounds<<<1024, 256, 0, stream.get()>>>(views.u, all, bounds.data()); });
  const double pixels = static_cast<double>(views.maps.pixels()) * views.count;
  launch(stream, {"ordering: pulls", pixels * 44, pixels * 400}, [&] {
    majorise_views<<<blocks_of(views.maps, views.count), dim3(32, 8), 0, stream.get()>>>(
        views, penalty, bounds.data(), problem);
  });
}

OrderedLines count_lines(const OrderedMaps& maps, const float* u, float limit,
                         const DeviceStream& stream) {
  DeviceArray<unsigned long long> counts(2, stream);
  counts.clear();
  const int views = maps.grid.count();
  const double pixels = static_cast<double>(maps.pixels()) * views;
  launch(stream, {"ordering: violations", pixels * 4, pixels * 40}, [&] {
    count_all<<<blocks_of(maps, views), dim3(32, 8), 0, stream.get()>>>(maps, u, limit,
                                                                        counts.data());
  });
  unsigned long long host[2] = {};
  check(cudaMemcpyAsync(host, counts.data(), sizeof host, cudaMemcpyDeviceToHost, stream.get()));
  stream.wait();
  return {static_cast<long>(host[0]), static_cast<long>(host[1])};
}

}  // namespace episcope::cuda
