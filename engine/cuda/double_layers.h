// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/view_stack.h"
#include "engine/cuda/device_data.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace episcope::cuda {

/// A small odd filter, centerd: out(n) = Σ values[i]·in(n + i − radius).
struct DoubleTaps {
  static constexpr int kMost = 13;
  int radius = 0;
  float values[kMost] = {};
};

/// The filters of one direction of EPIs; see SecondOrderFilters.
struct DoublePass {
  bool is_horizontal = true;
  DoubleTaps along[3];  ///< One radius.
  DoubleTaps views[3];  ///< One radius.
  DoubleTaps integrate, across;
  float scale[3] = {1, 1, 1};
  float mix = 0;
  float contrast_energy = 0, noise_energy = 0;
  int first_product = 0, last_product = 0;  ///< Views [first, last) where derivatives exist.
  std::vector<float> row_weights;           ///< `[row][product row]`
  int tile_height = 1, tile_width = 1;      ///< Of the tiles that are counted,
  int tile_stride = 1;                      ///< of which one of so many has results.
};

/// Where two disparities are looked for; see DoubleShear.
struct DoubleShears {
  std::vector<int> steps;
  float limit = 0;
  float min = 0, max = 0;
  float min_distance = 0;
};

/// Where the results go, stacks of the same views; `confidence` in 1/255.
struct DoubleResults {
  ViewStack<float>& near;
  ViewStack<float>& far;
  ViewStack<std::uint8_t>& confidence;
};

struct LayerMemory;

/// Two disparities and their confidence on the device, of the views of `like`, computed on its
/// stream; `like` must live as long. Move-only.
class DeviceLayers {
 public:
  /// As below. Throws DeviceFailure, Cancelled.
  DeviceLayers(const LightField& light_field, const std::vector<DoublePass>& passes,
               const DoubleShears& shears, DeviceMaps& like, const Progress& progress);
  ~DeviceLayers();
  DeviceLayers(DeviceLayers&&) noexcept;

  /// For the steps that follow.
  [[nodiscard]] LayerMemory& memory() { return *memory_; }

 private:
  std::unique_ptr<LayerMemory> memory_;
};

/// `measure_double_layers` on the device: passes are merged one after the other. Throws
/// DeviceFailure, Cancelled.
void measure_double_layers(const LightField& light_field, const std::vector<DoublePass>& passes,
                           const DoubleShears& shears, const DoubleResults& results,
                           const Progress& progress);

}  // namespace episcope::cuda
