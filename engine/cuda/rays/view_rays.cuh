// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/cuda/device/device_array.cuh"
#include "engine/cuda/rays/ray_labels.h"

#include <cstdint>

namespace episcope::cuda {

/// What is known of all views, on the device: borrowed. Null where nothing is.
struct ViewRays {
  GridShape grid;
  int height = 0, width = 0, layers = 0, channels = 0;
  const std::uint8_t* probabilities = nullptr;  ///< `[view][y][label][x]`
  const float *weights = nullptr, *disparity = nullptr;
  const std::uint8_t *valid = nullptr, *colors = nullptr;
  const float* costs = nullptr;   ///< 256
  const float* trusts = nullptr;  ///< most_difference + 1
  int most_difference = 0;
  float tolerance_px = 0;

  [[nodiscard]] __host__ __device__ long pixels() const {
    return static_cast<long>(height) * width;
  }
  /// The pixel of another view at which the ray of pixel (y, x) arrives, −1 if its point is not
  /// seen there: find_ray_targets of engine/labeling/rays/ray_targets.h, to the same bits.
  [[nodiscard]] __device__ std::int32_t target(int view, int other, int y, int x) const {
    const long here = view * pixels() + static_cast<long>(y) * width + x;
    const float d = disparity[here];
    const auto step_x = static_cast<float>(other % grid.u - view % grid.u);
    const auto step_y = static_cast<float>(other / grid.u - view / grid.u);
    const float at_x = __fadd_rn(__fsub_rn(static_cast<float>(x), __fmul_rn(d, step_x)), 0.5F);
    const float at_y = __fadd_rn(__fsub_rn(static_cast<float>(y), __fmul_rn(d, step_y)), 0.5F);
    if (!(at_x >= 0 && at_x < static_cast<float>(width) && at_y >= 0 &&
          at_y < static_cast<float>(height))) {
      return -1;
    }
    const std::int32_t target = static_cast<int>(at_y) * width + static_cast<int>(at_x);
    const long there = other * pixels() + target;
    if (!(fabsf(disparity[there] - d) <= tolerance_px)) return -1;
    if (valid != nullptr && (valid[here] == 0 || valid[there] == 0)) return -1;
    return target;
  }
  /// RayColors::trust of a pixel and of one of another view.
  [[nodiscard]] __device__ float trust(int view, std::int32_t pixel, int other,
                                       std::int32_t target) const {
    if (colors == nullptr) return 1;
    const std::uint8_t* const a = colors + (view * pixels() + pixel) * channels;
    const std::uint8_t* const b = colors + (other * pixels() + target) * channels;
    int sum = 0;
    for (int c = 0; c < channels; ++c) {
      const int difference = static_cast<int>(a[c]) - static_cast<int>(b[c]);
      sum += difference * difference;
    }
    if (channels == 1) sum *= 3;
    return trusts[sum < most_difference ? sum : most_difference];
  }
};

/// The memory behind ViewRays.
class ViewRaysMemory {
 public:
  /// Uploads everything. The stream must outlive it. Throws DeviceFailure, Cancelled.
  ViewRaysMemory(const RayLabelsTask& task, const DeviceStream& stream, const Progress& progress);

  [[nodiscard]] const ViewRays& rays() const { return rays_; }

 private:
  DeviceArray<std::uint8_t> probabilities_, valid_, colors_;
  DeviceArray<float> weights_, disparity_, costs_, trusts_;
  ViewRays rays_;
};

}  // namespace episcope::cuda
