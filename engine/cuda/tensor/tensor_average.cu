// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/tensor/cpu_order.cuh"
#include "engine/cuda/tensor/tensor_average.cuh"
#include "engine/cuda/tensor/tensor_choice.cuh"

namespace episcope::cuda {
namespace {

constexpr int kTile = 32;
constexpr int kRows = 8;

// What is known of one ray.
struct Orientation {
  float disparity, coherence;
};

// The slope of ∂s + d ∂x = 0, −d, of one tensor by least squares.
__device__ float slope_of(const Tensor& tensor) {
  return tensor.xs * reciprocal(tensor.xx + 1e-20F);
}

// Neighbours whose disparity differs by so much, squared, count half.
constexpr float kDisagreement = 0.09F;

__device__ float agreement(const Tensor& tensor, float own) {
  const float off = tensor.xs - own * tensor.xx;
  const float agreeing = kDisagreement * (tensor.xx * tensor.xx) + 1e-30F;
  return agreeing * reciprocal(agreeing + off * off);
}

// Least squares of ∂s + d ∂x = 0; coherence in the frame sheared by d.
__device__ Orientation read_off(const Tensor& sum, const AverageSettings& settings) {
  const float xx = sum.xx + 1e-20F;
  const float disparity = -sum.xs * reciprocal(xx);
  const float residual = fmaxf(sum.ss + disparity * sum.xs, 0);
  float coherence = (xx - residual) * reciprocal(xx + residual + settings.noise_energy);
  const bool inside = disparity >= settings.min && disparity <= settings.max;
  if (!(inside && coherence > 0)) coherence = 0;
  return {fminf(fmaxf(disparity, settings.min), settings.max), coherence};
}

// `best` stands at the lane of EPI 0 of the band.
__device__ Orientation averaged(const AveragedBand& averaged, const AverageSettings& settings,
                                const float* best, int epi) {
  const EpiBand& band = averaged.band;
  const long part = static_cast<long>(band.count) * band.length;
  const int radius = settings.across.count / 2;
  const auto tensor_of = [&](int i) {
    const int neighbour = min(max(epi + i, 0), averaged.last_epi) - band.first;
    return load(best + static_cast<long>(neighbour) * band.length, part);
  };
  const Tensor middle = tensor_of(0);
  const float own = slope_of(middle);
  Tensor sum{0, 0, 0};
  add(sum, settings.across.values[radius], middle);
  for (int i = -radius; i <= radius; ++i) {
    if (i == 0) continue;
    const Tensor tensor = tensor_of(i);
    add(sum, settings.across.values[radius + i] * agreement(tensor, own), tensor);
  }
  return read_off(sum, settings);
}

__device__ float raised(float base, int power) {
  float result = 1;
  for (; power > 0; power >>= 1) {
    if ((power & 1) != 0) result *= base;
    base *= base;
  }
  return result;
}

constexpr float kAgreement = 0.3F;

// Estimates of vertical EPIs merged into those of horizontal ones.
__device__ Orientation merged(const Orientation& vertical, const Orientation& horizontal,
                              const AverageSettings& settings) {
  const bool wins = vertical.coherence > horizontal.coherence;
  const Orientation winner = wins ? vertical : horizontal;
  const bool agree = fabsf(vertical.disparity - horizontal.disparity) < kAgreement &&
                     vertical.coherence > 0 && horizontal.coherence > 0;
  if (settings.takes_winner || !agree) return winner;
  const float weight = raised(vertical.coherence, settings.fusion_power);
  const float share =
      weight / (weight + raised(horizontal.coherence, settings.fusion_power) + 1e-30F);
  return {horizontal.disparity + share * (vertical.disparity - horizontal.disparity),
          winner.coherence};
}

// Writes the estimate of a pixel of the maps; `pixel` is the same one of the samples.
__device__ void write(const DeviceSamples& samples, Orientation found,
                      const AverageSettings& settings, const MapPointers& maps, long at,
                      long pixel) {
  if (settings.outcome == Outcome::MergedIntoNothing) found = merged(found, {0, 0}, settings);
  if (settings.outcome == Outcome::MergedWithStored) {
    found = merged({maps.disparity[at], maps.confidence[at]}, found, settings);
  }
  if (settings.is_last) {
    if (samples.valid && samples.valid[pixel] == 0) found.coherence = 0;
    if (settings.squares_coherence) found.coherence *= found.coherence;
    if (settings.clamps) {
      found.disparity = fminf(fmaxf(found.disparity, settings.clamp_min), settings.clamp_max);
    }
  }
  maps.disparity[at] = found.disparity;
  maps.confidence[at] = found.coherence;
}

__device__ void write_at(const DeviceSamples& samples, const EpiBand& band, int view, int y, int x,
                         const Orientation& found, const AverageSettings& settings,
                         const MapPointers& maps) {
  const int v = band.is_vertical ? view : band.line, u = band.is_vertical ? band.line : view;
  const long inside = static_cast<long>(y) * samples.width + x;
  const long size = static_cast<long>(samples.height) * samples.width;
  write(samples, found, settings, maps, maps.index(v, u) * size + inside,
        samples.pixel(v, u, y, x));
}

template <bool kVertical>
__global__ __launch_bounds__(kTile* kRows) void average(DeviceSamples samples, AveragedBand band,
                                                        WantedViews wanted, const float* best,
                                                        AverageSettings settings,
                                                        MapPointers maps) {
  __shared__ float2 tile[kTile][kTile + 1];
  const int view = static_cast<int>(blockIdx.z);
  const int first_lane = static_cast<int>(blockIdx.x) * kTile;
  const int first_epi = band.first + static_cast<int>(blockIdx.y) * kTile;
  const int lane = first_lane + static_cast<int>(threadIdx.x);
  const int end = band.first + band.count;
  best += 3L * view * band.band.count * band.band.length + lane;
  for (int i = threadIdx.y; i < kTile; i += kRows) {
    const int epi = first_epi + i;
    if (lane >= band.band.length || epi >= end) continue;
    const Orientation found = averaged(band, settings, best, epi);
    if (kVertical) {
      tile[i][threadIdx.x] = {found.disparity, found.coherence};
    } else {
      write_at(samples, band.band, wanted.first + view, epi, lane, found, settings, maps);
    }
  }
  if (!kVertical) return;
  __syncthreads();
  // Lanes are rows of the image: neighbouring threads write neighbouring columns.
  const int x = first_epi + static_cast<int>(threadIdx.x);
  for (int i = threadIdx.y; i < kTile; i += kRows) {
    const int y = first_lane + i;
    if (y >= band.band.length || x >= end) continue;
    const float2 found = tile[threadIdx.x][i];
    write_at(samples, band.band, wanted.first + view, y, x, {found.x, found.y}, settings, maps);
  }
}

}  // namespace

void average_tensors(const DeviceSamples& samples, const AveragedBand& band, WantedViews wanted,
                     const float* best, const AverageSettings& settings, const MapPointers& maps,
                     const DeviceStream& stream) {
  const bool is_vertical = band.band.is_vertical;
  const dim3 grid(blocks_for(band.band.length, kTile), blocks_for(band.count, kTile),
                  static_cast<unsigned>(wanted.count()));
  const double rays = static_cast<double>(band.count) * band.band.length * wanted.count();
  const double maps_moved = settings.outcome == Outcome::MergedWithStored ? 4 : 2;
  const KernelWork work{is_vertical ? "averages, vertical" : "averages, horizontal",
                        rays * (3 + maps_moved) * sizeof(float),
                        rays * (settings.across.count * 18.0 + 20)};
  launch(stream, work, [&] {
    const auto kernel = is_vertical ? average<true> : average<false>;
    kernel<<<grid, dim3(kTile, kRows), 0, stream.get()>>>(samples, band, wanted, best, settings,
                                                          maps);
  });
}

}  // namespace episcope::cuda
