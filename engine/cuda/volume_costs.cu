// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/stereo_matcher.h"

#include "engine/cuda/device.cuh"

#include <numeric>
#include <vector>

namespace episcope::cuda {
namespace {

constexpr int kThreads = 128;

struct Planes {
  float* before;
  float* here;
  float* after;
  float* mean;
};

__device__ const float* column_of(const VolumeView<const float>& costs, int y, int x) {
  return costs.data + static_cast<long>(y) * costs.layers * costs.width + x;
}

__global__ void take_costs(VolumeView<const float> costs, const int* labels, Planes planes) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  if (x >= costs.width) return;
  const float* const column = column_of(costs, y, x);
  float sum = 0;
#pragma unroll 8
  for (int l = 0; l < costs.layers; ++l) sum += column[static_cast<long>(l) * costs.width];
  const long at = static_cast<long>(y) * costs.width + x;
  const int label = labels[at];
  const auto cost = [&](int l) { return column[static_cast<long>(l) * costs.width]; };
  planes.before[at] = cost(max(label - 1, 0));
  planes.here[at] = cost(label);
  planes.after[at] = cost(min(label + 1, costs.layers - 1));
  planes.mean[at] = sum / static_cast<float>(costs.layers);
}

// The label of least cost of a column, of equals the lowest.
__device__ int least_label(const VolumeView<const float>& costs, const float* column) {
  float least = column[0];
  int best = 0;
#pragma unroll 8
  for (int l = 1; l < costs.layers; ++l) {
    const float cost = column[static_cast<long>(l) * costs.width];
    best = cost < least ? l : best;
    least = fminf(least, cost);
  }
  return best;
}

__global__ void find_least(VolumeView<const float> costs, int* labels) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  if (x >= costs.width) return;
  labels[static_cast<long>(y) * costs.width + x] = least_label(costs, column_of(costs, y, x));
}

__global__ void sum_best(VolumeView<const float> costs, const std::uint8_t* valid, int reach,
                         double* parts) {
  __shared__ double shared[kThreads];
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  double own = 0;
  if (x < costs.width && (valid == nullptr || valid[static_cast<long>(y) * costs.width + x] != 0)) {
    const float* const column = column_of(costs, y, x);
    const int best = least_label(costs, column);
    const int first = max(0, best - reach), last = min(costs.layers - 1, best + reach);
    for (int l = first; l <= last; ++l) {
      own += static_cast<double>(column[static_cast<long>(l) * costs.width]);
    }
    own /= last - first + 1;
  }
  shared[threadIdx.x] = own;
  __syncthreads();
  for (int half = kThreads / 2; half > 0; half /= 2) {
    if (static_cast<int>(threadIdx.x) < half) shared[threadIdx.x] += shared[threadIdx.x + half];
    __syncthreads();
  }
  if (threadIdx.x == 0) parts[static_cast<long>(blockIdx.y) * gridDim.x + blockIdx.x] = shared[0];
}

dim3 grid_of(const VolumeView<const float>& costs) {
  return {blocks_for(costs.width, kThreads), static_cast<unsigned>(costs.height)};
}

}  // namespace

CostsAtLabels costs_at_labels(const DeviceVolume& volume, const Image<int>& labels,
                              const Progress& progress) {
  const DeviceStream stream;
  const VolumeView<const float> costs = volume.view();
  const std::size_t pixels = labels.size();
  const auto on_device = upload(labels.data(), pixels, stream, progress);
  DeviceArray<float> planes(4 * pixels, stream);
  const Planes to{planes.data(), planes.data() + pixels, planes.data() + 2 * pixels,
                  planes.data() + 3 * pixels};
  const auto values = static_cast<double>(costs.size());
  launch(stream, {"stereo: costs at labels", 4 * values, values}, [&] {
    take_costs<<<grid_of(costs), kThreads, 0, stream.get()>>>(costs, on_device.data(), to);
  });
  CostsAtLabels result;
  std::size_t number = 0;
  for (Image<float>* image : {&result.before, &result.here, &result.after, &result.mean}) {
    *image = Image<float>(labels.height(), labels.width());
    download_bytes(image->data(), planes.data() + number++ * pixels, pixels * sizeof(float), stream,
                   progress);
  }
  return result;
}

Image<int> least_labels(const DeviceVolume& volume, const Progress& progress) {
  const DeviceStream stream;
  const VolumeView<const float> costs = volume.view();
  Image<int> labels(costs.height, costs.width);
  DeviceArray<int> on_device(labels.size(), stream);
  const auto values = static_cast<double>(costs.size());
  launch(stream, {"stereo: least labels", 4 * values, 2 * values}, [&] {
    find_least<<<grid_of(costs), kThreads, 0, stream.get()>>>(costs, on_device.data());
  });
  download_bytes(labels.data(), on_device.data(), on_device.byte_size(), stream, progress);
  return labels;
}

double sum_around_best(const DeviceVolume& volume, const std::uint8_t* valid, int reach,
                       const Progress& progress) {
  const DeviceStream stream;
  const VolumeView<const float> costs = volume.view();
  const auto pixels = static_cast<std::size_t>(costs.height) * costs.width;
  const auto mask = upload(valid, valid == nullptr ? 0 : pixels, stream, progress);
  const dim3 grid = grid_of(costs);
  std::vector<double> parts(static_cast<std::size_t>(grid.x) * grid.y);
  DeviceArray<double> on_device(parts.size(), stream);
  const auto values = static_cast<double>(costs.size());
  launch(stream, {"stereo: cost unit", 4 * values, 2 * values}, [&] {
    sum_best<<<grid, kThreads, 0, stream.get()>>>(costs, mask.data(), reach, on_device.data());
  });
  download_bytes(parts.data(), on_device.data(), on_device.byte_size(), stream, progress);
  return std::accumulate(parts.begin(), parts.end(), 0.0);
}

}  // namespace episcope::cuda
