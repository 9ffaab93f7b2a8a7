// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/cuda/device_data.cuh"
#include "engine/cuda/orientations.h"
#include "engine/disparity/kernels/shared_constants.h"

#include <cstdint>

namespace episcope::cuda {

/// All views `[v][u][y][x]` with each pixel packed into one word; see PackedViews.
struct PackedField {
  const std::uint32_t* pixels = nullptr;
  GridShape grid;
  int height = 0, width = 0;
  bool has_invalid = false;

  [[nodiscard]] __device__ const std::uint32_t* view(int v, int u) const {
    return pixels + (static_cast<long>(v) * grid.u + u) * height * width;
  }
  [[nodiscard]] __device__ bool contains(int v, int u) const {
    return v >= 0 && v < grid.v && u >= 0 && u < grid.u;
  }
};

/// One that owns its memory.
class PackedFieldMemory {
 public:
  /// Throws DeviceFailure.
  PackedFieldMemory(const DeviceSamples& samples, const DeviceStream& stream);
  [[nodiscard]] const PackedField& field() const { return field_; }

 private:
  DeviceArray<std::uint32_t> pixels_;
  PackedField field_;
};

/// Channel `c` in units of 1/1023.
__device__ inline int packed_channel(std::uint32_t packed, int c) {
  return static_cast<int>(packed >> (kPackedBits * c)) & kPackedMost;
}
__device__ inline bool is_valid(std::uint32_t packed) {
  return (packed >> kPackedInvalidBit & 1) == 0;
}

/// A pixel of a view.
struct RayPlace {
  int v, u, y, x;
};

/// How well a ray agrees with its line: see LineResiduals and ResidualKernel.

/// In units of 1/1023, plus 2²³: differences are exact, and no conversion is needed.
struct PackedColor {
  float channel[3];
};

__device__ inline PackedColor unpacked(std::uint32_t packed) {
  constexpr std::uint32_t kExponent = 0x4B000000U;
  PackedColor color;
  for (int c = 0; c < 3; ++c) {
    color.channel[c] =
        __uint_as_float(kExponent | (packed >> (kPackedBits * c) & std::uint32_t{kPackedMost}));
  }
  return color;
}

/// An arm with fewer views that see the line does not count.
__device__ inline int min_arm_views(GridShape grid) {
  return min(max(max(grid.u, grid.v) / 2, 1), 2);
}

/// Mean squared difference along the views of an arm, (dv, du) from one to the next; infinite where
/// it does not count.
__device__ inline float arm_residual(const PackedField& field, const RayPlace& ray, int dv, int du,
                                     const PackedColor& own, float disparity) {
  const bool vertical = dv != 0;
  const int last = (vertical ? field.height : field.width) - 1;
  const int stride = vertical ? field.width : 1;
  const int line = vertical ? ray.x : ray.y * field.width;
  const auto start = static_cast<float>(vertical ? ray.y : ray.x);
  float sum = 0;
  int count = 0;
#pragma unroll
  for (int k = 1; k <= kMaxArmViews; ++k) {
    const int v = ray.v + k * dv, u = ray.u + k * du;
    if (!field.contains(v, u)) break;
    const float at = __fmaf_rn(disparity, static_cast<float>(-(dv + du) * k), start);
    if (!(at >= 0 && at <= static_cast<float>(last))) break;  // nor in the views beyond
    const int tap = static_cast<int>(at);
    const float weight = at - static_cast<float>(tap);
    const std::uint32_t* const from = field.view(v, u) + line;
    const std::uint32_t first = __ldg(from + tap * stride);
    const std::uint32_t second = __ldg(from + min(tap + 1, last) * stride);
    if (field.has_invalid && !(is_valid(first) && is_valid(second))) continue;
    const PackedColor a = unpacked(first), b = unpacked(second);
    float square = 0;
    for (int c = 0; c < 3; ++c) {
      const float off =
          __fmaf_rn(weight, b.channel[c] - a.channel[c], a.channel[c] - own.channel[c]);
      square = __fmaf_rn(off, off, square);
    }
    sum += square;
    ++count;
  }
  if (count < min_arm_views(field.grid)) return INFINITY;
  return sum / fmaxf(static_cast<float>(count), 1);
}

/// Least mean squared difference of the four arms, samples in [0, 1]; infinite where none counts.
/// kUnrolled = 1 where more registers than one arm needs would be too many.
template <int kUnrolled = 4>
__device__ inline float line_residual(const PackedField& field, const RayPlace& ray,
                                      float disparity) {
  constexpr float kUnit = 1.0F / static_cast<float>(kPackedMost);
  const std::uint32_t packed =
      field.view(ray.v, ray.u)[static_cast<long>(ray.y) * field.width + ray.x];
  if (field.has_invalid && !is_valid(packed)) return INFINITY;
  const PackedColor own = unpacked(packed);
  float best = INFINITY;
#pragma unroll kUnrolled
  for (int arm = 0; arm < 4; ++arm) {
    const int step = (arm & 1) == 0 ? 1 : -1;
    best = fminf(best,
                 arm_residual(field, ray, arm < 2 ? 0 : step, arm < 2 ? step : 0, own, disparity));
  }
  return best * (kUnit * kUnit);
}

/// `check_lines` of maps on the device, on a stream. Throws DeviceFailure, Cancelled.
void check_lines_on_device(const DeviceSamples& samples, const LineCheckSteps& steps,
                           const MapPointers& maps, const DeviceStream& stream,
                           const Progress& progress);

}  // namespace episcope::cuda
