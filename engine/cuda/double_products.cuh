// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device.cuh"
#include "engine/cuda/device_data.cuh"
#include "engine/cuda/orientations.h"

#include <cstdint>

namespace episcope::cuda {

/// What DeviceLayers holds, `[v][u][y][x]`; `confidence` in 1/255.
struct LayerMemory {
  LayerMemory(std::size_t pixels, const DeviceStream& stream)
      : near(pixels, stream), far(pixels, stream), confidence(pixels, stream) {}

  DeviceArray<float> near, far;
  DeviceArray<std::uint8_t> confidence;
};

/// Planes of pixels with `margin` more at either end of the image axis of EPIs: x of horizontal
/// ones, y of vertical ones. a counts along that axis, b along the other.
struct DoublePlanes {
  bool is_horizontal = true;
  int height = 0, width = 0;  ///< Of the views.
  int margin = 0;

  [[nodiscard]] __host__ __device__ int length() const { return is_horizontal ? width : height; }
  [[nodiscard]] __host__ __device__ int breadth() const { return is_horizontal ? height : width; }
  [[nodiscard]] __host__ __device__ long size() const {
    return static_cast<long>(length() + 2 * margin) * breadth();
  }
  [[nodiscard]] __device__ bool has(int a) const { return a >= -margin && a < length() + margin; }
  [[nodiscard]] __host__ __device__ long at(int a, int b) const {
    return is_horizontal ? static_cast<long>(b) * (width + 2 * margin) + a + margin
                         : static_cast<long>(a + margin) * width + b;
  }
  /// Clamps a to the image: beyond it samples repeat, and so do derivatives.
  [[nodiscard]] __device__ long at_clamped(int a, int b) const {
    return at(min(max(a, -margin), length() - 1 + margin), b);
  }
};

/// What kernels take of a pass.
struct DoubleFilters {
  DoubleTaps along[3], views[3], integrate, across;
  float scale[3];
  float mix;
  float contrast_energy, noise_energy;
};

/// The EPIs of one row or column of cameras.
struct DoubleLine {
  DeviceSamples samples;
  int number = 0;  ///< Of the row, or column.
  int rows = 0;    ///< Views along it.
  int first_product = 0, product_rows = 0;
};

/// Derivatives of all orders along the image axis, `[order][c][row]` planes.
void differentiate(const DoubleLine& line, const DoubleFilters& filters, const DoublePlanes& planes,
                   float* derivatives, const DeviceStream& stream);
/// Products of one shear, integrated along the image axis, `[which of 6][product row]` planes.
void multiply(const DoubleLine& line, const DoubleFilters& filters, int step,
              const DoublePlanes& of_derivatives, const float* derivatives,
              const DoublePlanes& planes, float* products, const DeviceStream& stream);
/// Products integrated across EPIs.
void average_across(const DoubleLine& line, const DoubleFilters& filters,
                    const DoublePlanes& planes, const float* products, float* averaged,
                    const DeviceStream& stream);

/// Views [first, first + count) of the line whose results are wanted, `[view][y][x]`.
struct DoubleBest {
  int first = 0, count = 0;
  float* near = nullptr;
  float* far = nullptr;
  float* confidence = nullptr;
};
/// Limits of one shear.
struct DoubleLimits {
  int step = 0;
  float limit = 0, min = 0, max = 0, min_distance = 0;
};
/// Integrates along the views, solves for both disparities and keeps the better answer.
void select(const DoubleLine& line, const DoubleFilters& filters, const float* row_weights,
            const DoubleLimits& limits, const DoublePlanes& planes, const float* products,
            const DoubleBest& best, const DeviceStream& stream);

}  // namespace episcope::cuda
