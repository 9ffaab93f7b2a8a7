// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cuda/device/launch.cuh"
#include "engine/cuda/stereo/cost_winners.cuh"

namespace episcope::cuda {
namespace {

// As in stereo_local.cpp.
constexpr float kFlat = 2e-4F;

__global__ void choose(VolumeView<const float> costs, LabelPlaces places, float* disparity,
                       float* confidence) {
  const int x = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  const int y = static_cast<int>(blockIdx.y);
  if (x >= costs.width) return;
  const float* const column = costs.data + static_cast<long>(y) * costs.layers * costs.width + x;
  float least = INFINITY, sum = 0;
  int best = 0;
#pragma unroll 8
  for (int label = 0; label < costs.layers; ++label) {
    const float cost = column[static_cast<long>(label) * costs.width];
    sum += cost;
    best = cost < least ? label : best;
    least = cost < least ? cost : least;
  }
  auto place = static_cast<float>(best);
  if (best > 0 && best + 1 < costs.layers) {
    place += offset_between(column[static_cast<long>(best - 1) * costs.width], least,
                            column[static_cast<long>(best + 1) * costs.width], places.refinement);
  }
  const long at = static_cast<long>(y) * costs.width + x;
  disparity[at] = places.first + place * places.step;
  const float mean = sum / static_cast<float>(costs.layers);
  confidence[at] = fminf(fmaxf((mean - least) / (mean + kFlat), 0.0F), 1.0F);
}

}  // namespace

void choose_winners(VolumeView<const float> costs, const LabelPlaces& places, float* disparity,
                    float* confidence, const DeviceStream& stream) {
  constexpr int kThreads = 128;
  const dim3 grid(blocks_for(costs.width, kThreads), static_cast<unsigned>(costs.height));
  const auto values = static_cast<double>(costs.size());
  launch(stream, {"stereo: winners", 4 * values, 3 * values}, [&] {
    choose<<<grid, kThreads, 0, stream.get()>>>(costs, places, disparity, confidence);
  });
}

}  // namespace episcope::cuda
