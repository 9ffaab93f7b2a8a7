// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/tensor/cpu_order.cuh"
#include "engine/cuda/tensor/derivative_planes.cuh"

#include <algorithm>

namespace episcope::cuda {
namespace {

constexpr int kTileEpis = 16;
constexpr int kTileLanes = 64;
constexpr int kThreads = 256;
// Lanes that derivatives reach, half a pixel further ones included.
constexpr int kReach = 3;
constexpr int kMaxRadius = 6;
constexpr int kWide = kTileLanes + 2 * (kReach + kMaxRadius);
constexpr int kWidePitch = kWide + 1;  // odd, for writes across lanes

struct Tile {
  int epi, lane;  // the first of each: an EPI of the band, a lane of a view
  int view;
};

// A sample of lane `lane` of an EPI, ends repeated; NaN if it is not valid.
template <bool kVertical>
__device__ float sample_at(const DeviceSamples& samples, const EpiBand& band, const Tile& tile,
                           int epi, int lane, int channel) {
  const int along = min(max(lane, 0), band.length - 1);
  const int across = band.first + min(tile.epi + epi, band.count - 1);
  const long pixel = kVertical ? samples.pixel(tile.view, band.line, along, across)
                               : samples.pixel(band.line, tile.view, across, along);
  if (samples.valid && samples.valid[pixel] == 0) return nanf("");
  return samples.at(pixel, channel);
}

template <bool kVertical>
__device__ void read_tile(const DeviceSamples& samples, const EpiBand& band, const Tile& tile,
                          int channel, int reach, float (&to)[kTileEpis][kWidePitch]) {
  const int wide = kTileLanes + 2 * reach;
  for (int i = threadIdx.x; i < kTileEpis * wide; i += kThreads) {
    // Neighbouring threads read neighbouring pixels of the view.
    const int epi = kVertical ? i % kTileEpis : i / wide;
    const int lane = kVertical ? i / kTileEpis : i % wide;
    to[epi][lane] =
        sample_at<kVertical>(samples, band, tile, epi, tile.lane + lane - reach, channel);
  }
}

// Of three neighbouring lanes: central difference, and Scharr's smoothing.
__device__ float2 derivatives(float left, float here, float right) {
  return {0.5F * (right - left), two_products(3.0F / 16, left + right, 10.0F / 16, here)};
}

// Between in[0] and in[1].
__device__ float half_pixel(const float* in) {
  return two_products(9.0F / 16, in[0] + in[1], -1.0F / 16, in[-1] + in[2]);
}

__device__ float smoothed(const float* in, const LaneTaps& taps) {
  const int radius = taps.count / 2;
  const float* const middle = taps.values + radius;
  if (radius == 0) return middle[0] * in[0];
  float sum = two_products(middle[0], in[0], middle[1], in[1]);
  sum = __fmaf_rn(middle[-1], in[-1], sum);
  for (int i = 2; i <= radius; ++i) {
    sum = __fmaf_rn(middle[i], in[i], sum);
    sum = __fmaf_rn(middle[-i], in[-i], sum);
  }
  return sum;
}

template <bool kVertical>
__global__ __launch_bounds__(kThreads) void fill_planes(DeviceSamples samples, EpiBand band,
                                                        LaneTaps taps, DerivativePlanes planes) {
  __shared__ float raw[kTileEpis][kWidePitch];
  __shared__ float smooth[kTileEpis][kWidePitch];
  const int view = static_cast<int>(blockIdx.z) / band.channels;
  const int channel = static_cast<int>(blockIdx.z) % band.channels;
  const Tile tile{static_cast<int>(blockIdx.y) * kTileEpis,
                  static_cast<int>(blockIdx.x) * kTileLanes - band.margin, view};
  const int radius = taps.count / 2;
  read_tile<kVertical>(samples, band, tile, channel, kReach + radius, raw);
  __syncthreads();
  constexpr int kSmoothed = kTileLanes + 2 * kReach;
  for (int i = threadIdx.x; i < kTileEpis * kSmoothed; i += kThreads) {
    const int epi = i / kSmoothed, lane = i % kSmoothed;
    smooth[epi][lane] = smoothed(&raw[epi][lane + radius], taps);
  }
  __syncthreads();
  const bool with_half = planes.with_half && ((view - band.center()) & 1) != 0;
  for (int i = threadIdx.x; i < kTileEpis * kTileLanes; i += kThreads) {
    const int epi = i / kTileLanes, lane = i % kTileLanes;
    const int at = tile.lane + lane;
    if (tile.epi + epi >= band.count || at + band.margin >= band.pitch) continue;
    const int from = (tile.epi + epi) * band.pitch + at;
    const float* const here = &smooth[epi][lane + kReach];
    planes.values[DerivativePlanes::whole(band, channel, view) + from] =
        derivatives(here[-1], here[0], here[1]);
    if (!with_half) continue;
    planes.values[DerivativePlanes::half(band, channel, view) + from] =
        derivatives(half_pixel(here - 1), half_pixel(here), half_pixel(here + 1));
  }
}

}  // namespace

LaneTaps lane_taps(const std::vector<float>& taps) {
  LaneTaps lane;
  lane.count = static_cast<int>(taps.size());
  std::copy(taps.begin(), taps.end(), lane.values);
  return lane;
}

void differentiate(const DeviceSamples& samples, const EpiBand& band, const LaneTaps& smooth,
                   const DerivativePlanes& planes, const DeviceStream& stream) {
  const dim3 grid(blocks_for(band.pitch, kTileLanes), blocks_for(band.count, kTileEpis),
                  static_cast<unsigned>(band.views * band.channels));
  const double samples_read =
      static_cast<double>(band.views) * band.channels * band.count * band.length;
  const int sample_bytes = samples.type == SampleType::UInt8    ? 1
                           : samples.type == SampleType::UInt16 ? 2
                                                                : 4;
  const double written = samples_read / band.length * band.pitch * (planes.with_half ? 1.5 : 1);
  const KernelWork work{band.is_vertical ? "derivatives, vertical" : "derivatives, horizontal",
                        samples_read * sample_bytes + written * sizeof(float2),
                        samples_read * (2.0 * smooth.count + 6) + (planes.with_half ? 12 : 0)};
  launch(stream, work, [&] {
    const auto kernel = band.is_vertical ? fill_planes<true> : fill_planes<false>;
    kernel<<<grid, kThreads, 0, stream.get()>>>(samples, band, smooth, planes);
  });
}

}  // namespace episcope::cuda
