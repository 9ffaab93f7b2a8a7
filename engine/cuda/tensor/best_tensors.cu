// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/tensor/best_tensors.cuh"
#include "engine/cuda/tensor/tensor_choice.cuh"
#include "engine/cuda/tensor/view_integration.cuh"

#include <algorithm>

namespace episcope::cuda {
namespace {

constexpr int kThreads = kSearchThreads;
constexpr int kLanes = kSearchLanes;
// Neighbouring lanes that a thread integrates together. In shared memory those of a block are
// ordered so that threads write side by side.
constexpr int kTogether = 4;
constexpr int kQuads = kLanes / kTogether;

__device__ int place_of_lane(int lane) {
  return lane % kTogether * kQuads + lane / kTogether;
}

// Σ taps·in of `count` taps, symmetric ones: samples of a pair are added first. In the same order
// as OrientationKernel::select, or one after the other as in EigenvectorKernel.
template <int kCount>
__device__ float integrated(const float* in, const float* taps, int count, bool one_by_one) {
  if (kCount > 0) count = kCount;
  if (count == 1) return taps[0] * in[0];
  if (one_by_one) {
    float sum = taps[0] * in[0];
#pragma unroll
    for (int i = 1; i < count; ++i) sum = __fmaf_rn(taps[i], in[i], sum);
    return sum;
  }
  const auto pair = [&](int i) { return i < count - 1 - i ? in[i] + in[count - 1 - i] : in[i]; };
  if (count == 2) return taps[0] * pair(0);
  float sum = two_products(taps[0], pair(0), taps[1], pair(1));
#pragma unroll
  for (int i = 2; i < (count + 1) / 2; ++i) sum = __fmaf_rn(taps[i], pair(i), sum);
  return sum;
}

// What a thread integrates: kTogether lanes of one view and what their filters take in besides.
template <int kTaps>
__device__ void choose_lanes(const ShearChoice& choice, const LaneTaps& taps, const float* from,
                             int pitch, int lanes, float* best) {
  constexpr int kVectors = kTaps > 0 ? (kTogether + kTaps + 2) / 4 : 1;
  float in[3][4 * kVectors];
  if (kTaps > 0) {
#pragma unroll
    for (int part = 0; part < 3; ++part) {
      const auto* const vectors = reinterpret_cast<const float4*>(from + part * pitch);
#pragma unroll
      for (int i = 0; i < kVectors; ++i) {
        const float4 four = vectors[i];
        in[part][4 * i] = four.x;
        in[part][4 * i + 1] = four.y;
        in[part][4 * i + 2] = four.z;
        in[part][4 * i + 3] = four.w;
      }
    }
  }
#pragma unroll
  for (int lane = 0; lane < kTogether; ++lane) {
    if (lane >= lanes) return;
    float sums[3];
#pragma unroll
    for (int part = 0; part < 3; ++part) {
      const float* const first =
          kTaps > 0 ? &in[part][kTaps > 0 ? lane : 0] : from + part * pitch + lane;
      sums[part] = integrated<kTaps>(first, taps.values, taps.count, choice.by_eigenvector());
    }
    choice.keep_better({sums[0], sums[1], sums[2]}, best + lane * kQuads, kLanes);
  }
}

// Integrates along the EPI, and keeps tensors that are more coherent than the best so far.
// kTaps: of the filter at whole pixels, 0 = any.
template <int kTaps>
__device__ void choose(const SearchJob& job, const ShearFrame& shear, const SearchPlace& place,
                       const ShearedTensors& tensors, float* best) {
  const TensorSearchFilters& filters = job.filters;
  const ShearChoice choice(filters, shear.half_steps);
  for (int i = threadIdx.x; i < place.views.count() * kQuads; i += kThreads) {
    const int view = i / kQuads, quad = i % kQuads;
    const int lanes = place.lanes - kTogether * quad;
    const float* const from = tensors.of(view) + kTogether * quad;
    float* const to = best + 4 * view * kLanes + quad;
    if (shear.is_half(place.views.first + view)) {
      choose_lanes<kTaps == 0 ? 0 : kTaps + 1>(choice, filters.along_half, from, tensors.pitch,
                                               lanes, to);
    } else {
      choose_lanes<kTaps>(choice, filters.along, from, tensors.pitch, lanes, to);
    }
  }
}

__device__ void write_best(const SearchJob& job, const SearchPlace& place, const float* best) {
  const EpiBand& band = job.band;
  for (int i = threadIdx.x; i < 3 * place.views.count() * kLanes; i += kThreads) {
    const int lane = i % kLanes, part = i / kLanes % 3, view = i / (3 * kLanes);
    if (lane >= place.lanes) continue;
    const long of = place.views.first - job.wanted.first + view;
    job.best[((3 * of + part) * band.count + place.epi) * band.length + place.first + lane] =
        best[(4 * view + part) * kLanes + place_of_lane(lane)];
  }
}

// kChannels: the views are nine; 0 = any number of channels and views.
template <int kChannels, int kReach, int kTaps>
__global__ __launch_bounds__(kThreads, kChannels > 0 ? 4 : 1) void search(
    const __grid_constant__ SearchJob job, const __grid_constant__ NineViewFilters nine) {
  extern __shared__ float4 shared[];
  const ShearedTensors tensors{reinterpret_cast<float*>(shared), job.tensor_pitch};
  float* const best = tensors.of(kViewsTogether);
  float* const products = best + 4 * kViewsTogether * kLanes;
  const SearchPlace place = search_place(job);
  for (int i = threadIdx.x; i < 4 * kViewsTogether * kLanes; i += kThreads) best[i] = 0;
  for (int s = 0; s < job.filters.shear_count; ++s) {
    const ShearFrame shear{job.filters.first_shear + s * job.filters.shear_step, job.band.center()};
    const ShearWindow window = shear_window(job, place, shear);
    __syncthreads();
    for (int lane = threadIdx.x; lane < window.count; lane += kThreads) {
      const TensorWriter writer(job, shear, place, tensors, lane);
      if constexpr (kChannels > 0) {
        integrate_nine_views<kChannels, kReach>(job, nine, shear, place, window.begin + lane,
                                                writer);
      } else {
        integrate_views(job, shear, place, window.begin + lane, products, writer);
      }
    }
    __syncthreads();
    choose<kTaps>(job, shear, place, tensors, best);
  }
  __syncthreads();
  write_best(job, place, best);
}

using Search = void (*)(const SearchJob, const NineViewFilters);

Search search_of(const SearchJob& job, const NineViewFilters& nine) {
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

KernelWork work_of(const SearchJob& job) {
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
  // What a row of four lanes reads beyond its view is not used, but must be there.
  constexpr int kUnit = 4;
  const int pitch = (kLanes + filters.along_half.count + kUnit) / kUnit * kUnit;
  const SearchJob job{band, planes, filters, wanted, best, pitch};
  const int products = nine.fits ? 0 : 3 * kProductViews * kThreads;
  const auto shared = (kViewsTogether * (3 * pitch + 4 * kLanes) + products) * sizeof(float);
  const Search kernel = search_of(job, nine);
  check(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize,
                             static_cast<int>(shared)));
  const dim3 grid(blocks_for(band.length, kLanes), static_cast<unsigned>(band.count),
                  blocks_for(wanted.count(), kViewsTogether));
  launch(stream, work_of(job),
         [&] { kernel<<<grid, kThreads, shared, stream.get()>>>(job, nine); });
}

}  // namespace episcope::cuda
