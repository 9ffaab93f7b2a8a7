// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/tensor/best_tensors.cuh"
#include "engine/cuda/tensor/tensor_choice.cuh"

#include <algorithm>

namespace episcope::cuda {
namespace {

constexpr int kTile = 128;     // lanes of a block
constexpr int kThreads = 160;  // with those that shears and filters reach
constexpr int kMaxTaps = ViewFilter::kMaxTaps;

struct Job {
  EpiBand band;
  DerivativePlanes planes;
  TensorSearchFilters filters;
  WantedViews wanted;
  float* best;
  int sheared_pitch;  // lanes of a row of tensors in sheared coordinates
  int product_views;  // views whose products are kept, unless in registers
};

// One shear about the centre: disparity k stands upright if view r is read at x − k·(r − centre).
struct Sheared {
  int half_steps, center;
  __device__ int steps(int view) const { return half_steps * (view - center); }
  // The first lane of sheared coordinates that lane 0 of a view stands at or before.
  __device__ int start(int view) const { return steps(view) >> 1; }
  __device__ bool is_half(int view) const { return (steps(view) & 1) != 0; }
  // Where a view is read for lane 0 of sheared coordinates.
  __device__ int source(int view) const { return -steps(view) >> 1; }
};

// What a block works on.
struct Place {
  int epi;    // of the band
  int first;  // lane
  int lanes;
  WantedViews views;
};

__device__ Place place_of(const Job& job) {
  const int first = static_cast<int>(blockIdx.x) * kTile;
  const int view = job.wanted.first + static_cast<int>(blockIdx.z) * kViewsTogether;
  return {static_cast<int>(blockIdx.y),
          first,
          min(kTile, job.band.length - first),
          {view, min(view + kViewsTogether, job.wanted.last)}};
}

// Sheared coordinates from `begin` on, `count` of them, in which the wanted views lie.
struct Window {
  int begin, count;
};

__device__ Window window_of(const Job& job, const Place& place, const Sheared& shear) {
  const int a = shear.start(place.views.first), b = shear.start(place.views.last - 1);
  const int taps = job.filters.along.count;
  return {place.first + min(a, b) - taps / 2, place.lanes + abs(a - b) + taps};
}

// Where the derivatives of a view stand for lane 0 of sheared coordinates.
__device__ int derivatives_at(const Job& job, const Sheared& shear, int epi, int channel,
                              int view) {
  const EpiBand& band = job.band;
  const int plane = shear.is_half(view) ? DerivativePlanes::half(band, channel, view)
                                        : DerivativePlanes::whole(band, channel, view);
  return plane + epi * band.pitch + shear.source(view);
}

// Tones strong gradients down; what an invalid sample entered counts nothing.
__device__ Tensor weighted(Tensor product, float contrast) {
  const float weight = __fdividef(contrast, product.xx + product.ss + contrast);
  const float xx = weight * product.xx, xs = weight * product.xs, ss = weight * product.ss;
  return {xx == xx ? xx : 0, xs == xs ? xs : 0, ss == ss ? ss : 0};
}

__device__ void add_square(Tensor& product, float along, float across) {
  product.xx += along * along;
  product.xs += along * across;
  product.ss += across * across;
}

// One derivative of nine views along the views, for view kView. Inner views at the usual scale have
// symmetric filters, whose pairs are added first.
template <int kReach>
__device__ float2 nine_view_gradient(const NineViewFilters& filters, const float2 (&in)[9],
                                     int view) {
  float2 g{0, 0};
  if (kReach == 2 && view >= 2 && view < 7) {
    g.x = filters.smooth[view][view] * in[view].x;
#pragma unroll
    for (int i = 1; i <= 2; ++i) {
      g.x += filters.smooth[view][view - i] * (in[view - i].x + in[view + i].x);
      g.y += filters.derivative[view][view - i] * (in[view - i].y - in[view + i].y);
    }
    return g;
  }
#pragma unroll
  for (int i = 0; i < 9; ++i) {
    if (i < view - kReach || i > view + kReach) continue;
    g.x += filters.smooth[view][i] * in[i].x;
    g.y += filters.derivative[view][i] * in[i].y;
  }
  return g;
}

// Tensors of nine views at a lane of sheared coordinates, integrated along the views.
template <int kChannels, int kReach>
__device__ void integrate_nine_views(const Job& job, const NineViewFilters& filters,
                                     const Sheared& shear, const Place& place, int lane,
                                     float* out) {
  Tensor products[9] = {};
#pragma unroll
  for (int channel = 0; channel < kChannels; ++channel) {
    float2 in[9];
#pragma unroll
    for (int view = 0; view < 9; ++view) {
      in[view] = job.planes.values[derivatives_at(job, shear, place.epi, channel, view) + lane];
    }
#pragma unroll
    for (int view = 0; view < 9; ++view) {
      const float2 g = nine_view_gradient<kReach>(filters, in, view);
      add_square(products[view], g.x, g.y);
    }
  }
#pragma unroll
  for (Tensor& product : products) product = weighted(product, job.filters.contrast_energy);
#pragma unroll
  for (int view = 0; view < 9; ++view) {
    if (view < place.views.first || view >= place.views.last) continue;
    Tensor sum{0, 0, 0};
#pragma unroll
    for (int i = 0; i < 9; ++i) {
      if (i < view - 4 || i > view + 4) continue;
      add(sum, filters.integrate[view][i], products[i]);
    }
    store(sum, out + 3L * (view - place.views.first) * job.sheared_pitch, job.sheared_pitch);
  }
}

// Taps of zero are left out, so that what they would read may be invalid.
__device__ float filtered(const Job& job, const Sheared& shear, const Place& place, int channel,
                          const ViewFilter& filter, int lane, float float2::*part) {
  float sum = 0;
  for (int i = 0; i < filter.count; ++i) {
    if (filter.taps[i] == 0) continue;
    sum +=
        filter.taps[i] *
        job.planes.values[derivatives_at(job, shear, place.epi, channel, filter.first + i) + lane].*
            part;
  }
  return sum;
}

// The same for any number of views and any filter. `products` has a column for each thread.
__device__ void integrate_views(const Job& job, const Sheared& shear, const Place& place, int lane,
                                float* products, float* out) {
  const ViewFilter& first_filter = job.filters.integrate[place.views.first];
  const ViewFilter& last_filter = job.filters.integrate[place.views.last - 1];
  const int first = first_filter.first, last = last_filter.first + last_filter.count;
  float* const column = products + threadIdx.x;
  for (int view = first; view < last; ++view) {
    Tensor product{0, 0, 0};
    for (int channel = 0; channel < job.band.channels; ++channel) {
      const float along =
          filtered(job, shear, place, channel, job.filters.smooth[view], lane, &float2::x);
      const float across =
          filtered(job, shear, place, channel, job.filters.derivative[view], lane, &float2::y);
      add_square(product, along, across);
    }
    store(weighted(product, job.filters.contrast_energy), column + 3L * (view - first) * kThreads,
          kThreads);
  }
  for (int view = place.views.first; view < place.views.last; ++view) {
    const ViewFilter& filter = job.filters.integrate[view];
    Tensor sum{0, 0, 0};
    for (int i = 0; i < filter.count; ++i) {
      add(sum, filter.taps[i], load(column + 3L * (filter.first + i - first) * kThreads, kThreads));
    }
    store(sum, out + 3L * (view - place.views.first) * job.sheared_pitch, job.sheared_pitch);
  }
}

// Integrates along the EPI, and keeps the tensor if it is more coherent than the best so far.
template <int kTaps>
__device__ void choose(const Job& job, const Sheared& shear, const Place& place,
                       const Window& window, const float* sheared, float* best) {
  const TensorSearchFilters& filters = job.filters;
  const ShearChoice choice(filters, shear.half_steps);
  for (int i = threadIdx.x; i < place.views.count() * kTile; i += kThreads) {
    const int view = i / kTile, lane = i % kTile;
    if (lane >= place.lanes) continue;
    const int of = place.views.first + view;
    const bool half = shear.is_half(of);
    const LaneTaps& taps = half ? filters.along_half : filters.along;
    const int at = place.first + lane + shear.start(of) - filters.along.count / 2 - window.begin;
    const float* const from = sheared + 3L * view * job.sheared_pitch + at;
    Tensor tensor{0, 0, 0};
    if (kTaps > 0) {
#pragma unroll
      for (int k = 0; k < kTaps; ++k)
        add(tensor, taps.values[k], load(from + k, job.sheared_pitch));
      if (half) add(tensor, taps.values[kTaps], load(from + kTaps, job.sheared_pitch));
    } else {
      for (int k = 0; k < taps.count; ++k) {
        add(tensor, taps.values[k], load(from + k, job.sheared_pitch));
      }
    }
    choice.keep_better(tensor, best + 4 * view * kTile + lane, kTile);
  }
}

__device__ void write_best(const Job& job, const Place& place, const float* best) {
  const EpiBand& band = job.band;
  for (int i = threadIdx.x; i < 3 * place.views.count() * kTile; i += kThreads) {
    const int lane = i % kTile, part = i / kTile % 3, view = i / (3 * kTile);
    if (lane >= place.lanes) continue;
    const long of = place.views.first - job.wanted.first + view;
    job.best[((3 * of + part) * band.count + place.epi) * band.length + place.first + lane] =
        best[(4 * view + part) * kTile + lane];
  }
}

// kNine: the views are nine; 0 = any number of channels, or any filter.
template <int kChannels, int kReach, int kTaps>
__global__ __launch_bounds__(kThreads, kChannels > 0 ? 4 : 1) void search(
    const __grid_constant__ Job job, const __grid_constant__ NineViewFilters nine) {
  extern __shared__ float shared[];
  float* const best = shared;
  float* const sheared = best + 4 * kViewsTogether * kTile;
  float* const products = sheared + 3 * kViewsTogether * job.sheared_pitch;
  const Place place = place_of(job);
  for (int i = threadIdx.x; i < 4 * kViewsTogether * kTile; i += kThreads) best[i] = 0;
  for (int s = 0; s < job.filters.shear_count; ++s) {
    const Sheared shear{job.filters.first_shear + s * job.filters.shear_step, job.band.center()};
    const Window window = window_of(job, place, shear);
    __syncthreads();
    for (int lane = threadIdx.x; lane < window.count; lane += kThreads) {
      if constexpr (kChannels > 0) {
        integrate_nine_views<kChannels, kReach>(job, nine, shear, place, window.begin + lane,
                                                sheared + lane);
      } else {
        integrate_views(job, shear, place, window.begin + lane, products, sheared + lane);
      }
    }
    __syncthreads();
    choose<kTaps>(job, shear, place, window, sheared, best);
  }
  __syncthreads();
  write_best(job, place, best);
}

using Search = void (*)(const Job, const NineViewFilters);

Search search_of(const Job& job, const NineViewFilters& nine) {
  if (!nine.fits) return search<0, 0, 0>;
  const bool usual = job.filters.along.count == 5;
  if (job.band.channels == 1) {
    if (!usual) return nine.reach == 2 ? search<1, 2, 0> : search<1, 3, 0>;
    return nine.reach == 2 ? search<1, 2, 5> : search<1, 3, 5>;
  }
  if (!usual) return nine.reach == 2 ? search<3, 2, 0> : search<3, 3, 0>;
  return nine.reach == 2 ? search<3, 2, 5> : search<3, 3, 5>;
}

int largest_tap_count(const std::vector<ViewFilter>& filters) {
  int largest = 0;
  for (const ViewFilter& filter : filters) largest = std::max(largest, filter.count);
  return largest;
}

KernelWork work_of(const Job& job) {
  const EpiBand& band = job.band;
  const double rays = static_cast<double>(band.count) * band.length;
  const double wanted = rays * job.wanted.count();
  const double planes = rays * band.views * band.channels * (job.planes.with_half ? 1.5 : 1);
  // At the usual scales: both derivatives, products, both integrations and the choice.
  const double operations = band.channels * 24 + 10 + 54 + 6 * job.filters.along.count + 25;
  return {band.is_vertical ? "best tensors, vertical" : "best tensors, horizontal",
          planes * sizeof(float2) + 3 * wanted * sizeof(float),
          wanted * job.filters.shear_count * operations};
}

}  // namespace

NineViewFilters nine_view_filters(const ViewFilters& filters) {
  NineViewFilters nine;
  if (filters.views() != 9) return nine;
  const auto fill = [](const std::vector<ViewFilter>& from, float(&to)[9][9]) {
    for (int view = 0; view < 9; ++view) {
      for (int i = 0; i < from[view].count; ++i)
        to[view][from[view].first + i] = from[view].taps[i];
    }
  };
  fill(filters.smooth, nine.smooth);
  fill(filters.derivative, nine.derivative);
  fill(filters.integrate, nine.integrate);
  nine.reach = largest_tap_count(filters.smooth) / 2;
  nine.fits = (nine.reach == 2 || nine.reach == 3) && largest_tap_count(filters.integrate) <= 9;
  return nine;
}

int needed_margin(const ViewFilters& filters, int largest_shear, int smooth_radius,
                  int integrate_radius) {
  constexpr int kDerivatives = 4;
  const int views = std::min(kViewsTogether, filters.views()) - 1 + filters.reach;
  return (views * largest_shear + 1) / 2 + integrate_radius + smooth_radius + kDerivatives;
}

void find_best_tensors(const EpiBand& band, const DerivativePlanes& planes,
                       const TensorSearchFilters& filters, const NineViewFilters& nine,
                       WantedViews wanted, float* best, const DeviceStream& stream) {
  Job job{band, planes, filters, wanted, best, 0, 0};
  job.sheared_pitch =
      kTile + (kViewsTogether * filters.largest_shear() + 1) / 2 + filters.along.count + 1;
  job.product_views = nine.fits ? 0 : kViewsTogether + kMaxTaps - 1;
  const auto shared = (4 * kViewsTogether * kTile + 3 * kViewsTogether * job.sheared_pitch +
                       3 * job.product_views * kThreads) *
                      sizeof(float);
  const Search kernel = search_of(job, nine);
  check(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize,
                             static_cast<int>(shared)));
  const dim3 grid(blocks_for(band.length, kTile), static_cast<unsigned>(band.count),
                  blocks_for(wanted.count(), kViewsTogether));
  launch(stream, work_of(job),
         [&] { kernel<<<grid, kThreads, shared, stream.get()>>>(job, nine); });
}

}  // namespace episcope::cuda
