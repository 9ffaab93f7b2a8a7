// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/tv_l2.h"

#include "engine/core/indices.h"
#include "engine/cuda/device.cuh"
#include "engine/cuda/device_data.cuh"
#include "engine/cuda/tv_l2.cuh"

#include <algorithm>

namespace episcope::cuda {
namespace {

// Maps of all views on the device, `[v][u][y][x]`.
struct OrderedMaps {
  GridShape grid;
  int height = 0, width = 0;

  [[nodiscard]] __host__ __device__ long pixels() const {
    return static_cast<long>(height) * width;
  }
};

// The four neighbors of a view in the grid. A point moves by −d for each step of u or v.
struct Way {
  int v = 0, u = 0;
  [[nodiscard]] __device__ bool is_vertical() const { return v != 0; }
  [[nodiscard]] __device__ float step() const { return static_cast<float>(-(u + v)); }
};
constexpr int kWays = 4;
__device__ inline Way way_of(int i) {
  return {i == 2 ? 1 : i == 3 ? -1 : 0, i == 0 ? 1 : i == 1 ? -1 : 0};
}

// Where a line ends: between pixels `tap` and the next along its axis; tap < 0 = outside.
struct LineEnd {
  int tap = -1;
  float weight = 0;  // Of the next.
};
__device__ inline LineEnd line_end(int start, float step, float slope, int last) {
  const float at = static_cast<float>(start) + step * slope;
  if (!(at >= 0 && at <= static_cast<float>(last))) return {};
  const int tap = min(static_cast<int>(at), max(last - 1, 0));
  return {tap, at - static_cast<float>(tap)};
}

// Along one axis of a map: the pixel at `position` of the line of pixels through (y, x).
struct Along {
  bool is_vertical = false;
  int y = 0, x = 0;
  int width = 0;
  [[nodiscard]] __device__ long at(int position) const {
    return is_vertical ? static_cast<long>(position) * width + x
                       : static_cast<long>(y) * width + position;
  }
};

// The difference along a line that ends at `end`: linear between pixels, less `from`.
__device__ inline float line_difference(const float* to, const Along& along, const LineEnd& end,
                                        int last, float from) {
  const float first = to[along.at(end.tap)];
  const float second = to[along.at(min(end.tap + 1, last))];
  return first + end.weight * (second - first) - from;
}

// As engine/solvers/ordering_terms.h.
struct DevicePenalty {
  float rise = 0, fall = 0.1F, softness = 0.05F;
};

// The views to be improved, by their numbers, and the maps of all.
struct OrderedViews {
  OrderedMaps maps;
  const int* numbers = nullptr;
  int count = 0;
  const float* u = nullptr;
  const float* observed = nullptr;
  const float* weights = nullptr;
  const float* edges = nullptr;
  const std::uint8_t* counts = nullptr;  // `[view]`: whether lines that end there count.
};

// ½ w (u − f)² and the majorizer of the ordering as one weighted observation for each view, and
// its edges: `[number][y][x]`.
struct OrderedProblem {
  float* f;
  float* w;
  float* g;
};

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

// Of the lines of a neighbor that end at a pixel, in the order of where they begin.
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

__global__ void majorize_views(OrderedViews views, DevicePenalty penalty, const Bounds* bounds,
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

void majorize(const OrderedViews& views, const DevicePenalty& penalty,
              const OrderedProblem& problem, const DeviceStream& stream) {
  DeviceArray<Bounds> bounds(1, stream);
  const long all = views.maps.grid.count() * views.maps.pixels();
  launch(stream, {"ordering: begin"},
         [&] { begin_bounds<<<1, 1, 0, stream.get()>>>(bounds.data()); });
  launch(stream, {"ordering: bounds", 4.0 * static_cast<double>(all)},
         [&] { find_bounds<<<1024, 256, 0, stream.get()>>>(views.u, all, bounds.data()); });
  const double pixels = static_cast<double>(views.maps.pixels()) * views.count;
  launch(stream, {"ordering: pulls", pixels * 44, pixels * 400}, [&] {
    majorize_views<<<blocks_of(views.maps, views.count), dim3(32, 8), 0, stream.get()>>>(
        views, penalty, bounds.data(), problem);
  });
}

// Waits for the stream.
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

// All that the device holds for the sweeps.
class Sweeper {
 public:
  Sweeper(const LightField& lf, const OrderingSweeps& sweeps, const ViewStack<float>& observed,
          const ViewStack<float>& confidence, const ViewStack<float>& u, const Progress& progress);

  // Improves all views of one color of the checkerboard; returns the largest relative gap.
  double improve(int color, const Progress& progress);
  void download_to(ViewStack<float>& u, const Progress& progress) {
    download(u, u_, stream_, progress);
  }

 private:
  [[nodiscard]] int count(int color) const { return static_cast<int>(views_[color].size()); }

  const OrderingSweeps& sweeps_;
  std::shared_ptr<const DeviceLightField> light_field_;
  OrderedMaps maps_;
  DeviceStream stream_;
  DeviceArray<float> observed_, u_, weights_, edges_;
  DeviceArray<std::uint8_t> counts_;
  DeviceArray<float> batch_f_, batch_w_, batch_g_;  // of the views of one color
  std::vector<int> views_[2];                       // their numbers
  DeviceArray<int> numbers_[2];
};

Sweeper::Sweeper(const LightField& lf, const OrderingSweeps& sweeps,
                 const ViewStack<float>& observed, const ViewStack<float>& confidence,
                 const ViewStack<float>& u, const Progress& progress)
    : sweeps_(sweeps),
      light_field_(on_device(lf, progress)),
      maps_{lf.grid(), lf.height(), lf.width()},
      observed_(upload(observed.data(), observed.size(), stream_, progress)),
      u_(upload(u.data(), u.size(), stream_, progress)),
      weights_(u.size(), stream_),
      edges_(u.size(), stream_),
      counts_(upload(sweeps.counts.data(), sweeps.counts.size(), stream_, progress)) {
  const auto trust = upload(confidence.data(), confidence.size(), stream_, progress);
  MapDenoising weighting;
  weighting.weight_power = sweeps.weight_power;
  weighting.min_weight = sweeps.min_weight;
  weighting.edge_strength = sweeps.edge_strength;
  fill_weights(light_field_->samples(), {lf.grid(), {}}, 0, lf.grid().count(), weighting,
               trust.data(), nullptr, {weights_.data(), edges_.data()}, stream_);
  for (int i = 0; i < lf.grid().count(); ++i) {
    const ViewIndex view = lf.grid().view_at(i);
    views_[(view.u + view.v) % 2].push_back(i);
  }
  const std::size_t batch = views_[0].size() * static_cast<std::size_t>(maps_.pixels());
  batch_f_ = {batch, stream_};
  batch_w_ = {batch, stream_};
  batch_g_ = {batch, stream_};
  for (int color : {0, 1}) {
    numbers_[color] = upload(views_[color].data(), views_[color].size(), stream_, Progress(1));
  }
}

double Sweeper::improve(int color, const Progress& progress) {
  if (views_[color].empty()) return 0;
  majorize({maps_, numbers_[color].data(), count(color), u_.data(), observed_.data(),
            weights_.data(), edges_.data(), counts_.data()},
           {sweeps_.rise, sweeps_.fall, sweeps_.softness},
           {batch_f_.data(), batch_w_.data(), batch_g_.data()}, stream_);
  TvL2DeviceSolver solver(maps_.height, maps_.width, count(color), stream_);
  double gap = 0;
  for (const TvL2Outcome& outcome :
       solver.solve({batch_f_.data(), batch_w_.data(), batch_g_.data(), sweeps_.lambda},
                    sweeps_.max_iterations, sweeps_.gap, progress, batch_f_.data())) {
    gap = std::max(gap, outcome.relative_gap());
  }
  for (int i = 0; i < count(color); ++i) {
    check(cudaMemcpyAsync(u_.data() + views_[color][i] * maps_.pixels(),
                          batch_f_.data() + i * maps_.pixels(), maps_.pixels() * sizeof(float),
                          cudaMemcpyDeviceToDevice, stream_.get()));
  }
  return gap;
}

}  // namespace

double sweep_in_order(const LightField& lf, const OrderingSweeps& sweeps,
                      const ViewStack<float>& observed, const ViewStack<float>& confidence,
                      ViewStack<float>& u, const Progress& progress) {
  Sweeper sweeper(lf, sweeps, observed, confidence, u, progress.part(0, 0.02));
  const Progress fitting = progress.part(0.02, 0.98);
  const double steps = 2.0 * sweeps.sweeps;
  double gap = 0;
  for (int i = 0; i < 2 * sweeps.sweeps && !progress.finish_requested(); ++i) {
    sweeps.on_half(i, gap);
    const double other = sweeper.improve(i % 2, fitting.part(i / steps, (i + 1) / steps));
    gap = i % 2 == 0 ? other : std::max(gap, other);
  }
  sweeper.download_to(u, progress.part(0.98, 1));
  return gap;
}

OrderedLines count_ordered_lines(const ViewStack<float>& disparity, float limit,
                                 const Progress& progress) {
  const DeviceStream stream;
  const auto maps = upload(disparity.data(), disparity.size(), stream, progress);
  return count_lines({disparity.grid(), disparity.height(), disparity.width()}, maps.data(), limit,
                     stream);
}

}  // namespace episcope::cuda
