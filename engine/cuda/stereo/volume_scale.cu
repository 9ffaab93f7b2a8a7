// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/stereo/volume_scale.cuh"

namespace episcope::cuda {
namespace {

constexpr int kThreads = 128;

__global__ void divide(VolumeView<float> costs, const float* caps, float mean) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  if (x >= costs.width) return;
  const float factor = mean / caps[static_cast<long>(y) * costs.width + x];
  float* const column = costs.data + static_cast<long>(y) * costs.layers * costs.width + x;
#pragma unroll 8
  for (int l = 0; l < costs.layers; ++l) column[static_cast<long>(l) * costs.width] *= factor;
}

}  // namespace

void divide_by_caps(DeviceVolume& costs, const float* caps, float mean,
                    const DeviceStream& stream) {
  const auto values = static_cast<double>(costs.values.size());
  const dim3 grid(blocks_for(costs.width, kThreads), static_cast<unsigned>(costs.height));
  const VolumeView<float> view{costs.values.data(), costs.height, costs.layers, costs.width};
  launch(stream, {"stereo: division by caps", 8 * values, values},
         [&] { divide<<<grid, kThreads, 0, stream.get()>>>(view, caps, mean); });
}

}  // namespace episcope::cuda
