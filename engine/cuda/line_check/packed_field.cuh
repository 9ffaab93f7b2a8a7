// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/light_field/device_light_field.cuh"
#include "engine/cuda/maps/map_pointers.cuh"

#include <cstdint>

namespace episcope::cuda {

/// As in packed_pixel.h.
inline constexpr int kPackedBits = 10;
inline constexpr int kPackedMost = (1 << kPackedBits) - 1;
inline constexpr int kPackedInvalidBit = 3 * kPackedBits;

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

}  // namespace episcope::cuda
