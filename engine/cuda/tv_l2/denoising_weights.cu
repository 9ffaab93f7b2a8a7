// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/light_field/channel_weight.h"
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/tv_l2/denoise_maps.cuh"

#include <cmath>

namespace episcope::cuda {
namespace {

// Which views kernels work on: block z is number `first` + z of the mapped ones.
struct Views {
  DeviceSamples samples;
  MappedViews mapped;
  int first = 0;

  [[nodiscard]] __device__ long pixel(int number, int y, int x) const {
    const int at = first + number;
    return samples.pixel(mapped.first.v + at / mapped.grid.u, mapped.first.u + at % mapped.grid.u,
                         y, x);
  }
};

__device__ long map_at(const DeviceSamples& samples, int number, int y, int x) {
  return (static_cast<long>(number) * samples.height + y) * samples.width + x;
}

// exp(−β |∇I|); 1 where an invalid pixel is part of the gradient.
__global__ void fill_edges(Views views, float strength, float* edges) {
  const DeviceSamples& samples = views.samples;
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
  if (x >= samples.width || y >= samples.height) return;
  const int number = static_cast<int>(blockIdx.z);
  const long here = views.pixel(number, y, x);
  const long right = views.pixel(number, y, min(x + 1, samples.width - 1));
  const long below = views.pixel(number, min(y + 1, samples.height - 1), x);
  float energy = 0;
  for (int c = 0; c < samples.channels; ++c) {
    const float own = samples.at(here, c);
    const float dx = samples.at(right, c) - own, dy = samples.at(below, c) - own;
    energy += dx * dx + dy * dy;
  }
  const bool is_valid =
      samples.valid == nullptr ||
      (samples.valid[here] != 0 && samples.valid[right] != 0 && samples.valid[below] != 0);
  const float weight = strength == 0 ? 1.0F : expf(-strength * sqrtf(energy));
  edges[map_at(samples, number, y, x)] = is_valid ? weight : 1.0F;
}

// r^power, at least the minimum.
struct Power {
  double power = 1;
  float minimum = 0;

  [[nodiscard]] __device__ float operator()(float r) const {
    const int whole = static_cast<int>(power);
    float raised = 1;
    if (whole == power) {
      for (int i = 0; i < whole; ++i) raised *= r;
    } else {
      raised = powf(r, static_cast<float>(power));
    }
    return fmaxf(raised, minimum);
  }
};

__global__ void fill_data(const float* confidence, Power power, long count, float* data) {
  const long at = static_cast<long>(blockIdx.x) * blockDim.x + threadIdx.x;
  if (at < count) data[at] = power(confidence[at]);
}

// local_noise_variance of a map at a pixel: in the direction in which it is least, the mean square
// of second differences over a window.
struct MapNoise {
  const float* map;
  int height = 0, width = 0;

  [[nodiscard]] __device__ float square(int y, int x, int way_y, int way_x) const {
    const int row = min(max(y, 1), height - 2), column = min(max(x, 1), width - 2);
    const float* const here = map + static_cast<long>(row) * width + column;
    const long step = static_cast<long>(way_y) * width + way_x;
    const float d = here[-step] - 2 * here[0] + here[step];
    return d * d / 6;
  }
  [[nodiscard]] __device__ float window(int y, int x, int way_y, int way_x) const {
    constexpr int kRadius = 2;
    const int top = max(y - kRadius, 0), bottom = min(y + kRadius, height - 1);
    const int left = max(x - kRadius, 0), right = min(x + kRadius, width - 1);
    float sum = 0;
    for (int i = left; i <= right; ++i) {
      for (int j = top; j <= bottom; ++j) sum += square(j, i, way_y, way_x);
    }
    return sum / static_cast<float>((right - left + 1) * (bottom - top + 1));
  }
  [[nodiscard]] __device__ float operator()(int y, int x) const {
    if (height < 3 || width < 3) return 0;
    return fminf(fminf(window(y, x, 0, 1), window(y, x, 1, 0)),
                 fminf(window(y, x, 1, 1), window(y, x, 1, -1)));
  }
};

// More weight where the map is trusted and its noise is less than `noise`: see `denoise`.
__global__ void raise_steady(DeviceSamples samples, const float* disparity, float noise,
                             float* data) {
  constexpr float most = 10, trusted = 0.06F;
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y * blockDim.y + threadIdx.y);
  if (x >= samples.width || y >= samples.height) return;
  const long at = map_at(samples, static_cast<int>(blockIdx.z), y, x);
  const MapNoise variance{disparity + map_at(samples, static_cast<int>(blockIdx.z), 0, 0),
                          samples.height, samples.width};
  const float own = sqrtf(variance(y, x));
  const float more = fmaxf(noise / fmaxf(own, noise / most), 1.0F) - 1;
  data[at] *= 1 + more * fminf(data[at] / trusted, 1.0F);
}

}  // namespace

void fill_weights(const DeviceSamples& samples, const MappedViews& views, int first, int count,
                  const MapDenoising& denoising, const float* confidence, const float* disparity,
                  const DenoisingWeights& weights, const DeviceStream& stream) {
  const dim3 block(32, 8);
  const dim3 grid(blocks_for(samples.width, 32), blocks_for(samples.height, 8),
                  static_cast<unsigned>(count));
  const double pixels = static_cast<double>(samples.height) * samples.width * count;
  const auto strength =
      static_cast<float>(denoising.edge_strength * std::sqrt(channel_weight(samples.channels)));
  launch(stream, {"denoise: edges", pixels * (samples.channels + 4), pixels * 20}, [&] {
    fill_edges<<<grid, block, 0, stream.get()>>>({samples, views, first}, strength, weights.edges);
  });
  const auto all = static_cast<long>(pixels);
  const Power power{denoising.weight_power, denoising.min_weight};
  launch(stream, {"denoise: weights", pixels * 8, pixels * 7}, [&] {
    fill_data<<<blocks_for(all, 256), 256, 0, stream.get()>>>(confidence, power, all, weights.data);
  });
  if (!(denoising.map_noise > 0)) return;
  launch(stream, {"denoise: steady pixels", pixels * 12, pixels * 600}, [&] {
    raise_steady<<<grid, block, 0, stream.get()>>>(samples, disparity, denoising.map_noise,
                                                   weights.data);
  });
}

}  // namespace episcope::cuda
