// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/light_field/device_light_field.cuh"

namespace episcope::cuda {

/// Samples of views as floats in [0, 1], planes `[view][channel][y][x]`; NaN = not valid.
struct ViewPlanes {
  const float* planes = nullptr;
  GridShape grid;
  ViewIndex reference;
  bool is_cross_hair = false;  ///< Only views of the reference's row and column are there.
  int height = 0, width = 0, channels = 0;

  /// Where a view stands among those that are there.
  [[nodiscard]] __host__ __device__ int slot(ViewIndex view) const {
    if (!is_cross_hair) return view.v * grid.u + view.u;
    return view.v == reference.v ? view.u : grid.u + view.v;
  }
  [[nodiscard]] __host__ __device__ int slots() const {
    return is_cross_hair ? grid.u + grid.v : grid.v * grid.u;
  }
  [[nodiscard]] __host__ __device__ ViewIndex view_of(int slot) const {
    if (!is_cross_hair) return {slot / grid.u, slot % grid.u};
    return slot < grid.u ? ViewIndex{reference.v, slot} : ViewIndex{slot - grid.u, reference.u};
  }
  [[nodiscard]] __host__ __device__ long plane_size() const {
    return static_cast<long>(height) * width;
  }
  [[nodiscard]] __device__ const float* of(ViewIndex view, int channel) const {
    return planes + (static_cast<long>(slot(view)) * channels + channel) * plane_size();
  }
};

/// Fills the planes of `views`, whose shape is set.
[[nodiscard]] DeviceArray<float> make_view_planes(const DeviceSamples& samples,
                                                  const ViewPlanes& views,
                                                  const DeviceStream& stream);

}  // namespace episcope::cuda
