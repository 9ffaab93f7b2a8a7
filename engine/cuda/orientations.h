// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/view_stack.h"
#include "engine/cuda/device_data.h"
#include "engine/disparity/kernels/shared_constants.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace episcope::cuda {

/// A banded filter along the views, for one of them: out = Σ taps[i]·in(first + i).
struct ViewFilter {
  int first = 0, count = 0;
  float taps[kMaxTaps] = {};
};

/// The filters along the views of EPIs in one direction, one for each view; see TensorFilters.
/// Empty = the grid has no such EPIs, or they are not wanted.
struct ViewFilters {
  std::vector<ViewFilter> smooth, derivative, integrate;
  int reach = 0;  ///< How many views away samples still matter for a result.
  [[nodiscard]] int views() const { return static_cast<int>(smooth.size()); }
};

/// Settings of a search for orientations; see StructureTensor and estimate_epi_l.
struct TensorSettings {
  ViewFilters horizontal, vertical;
  std::vector<float> smooth, integrate;  ///< Along the EPI, odd;
  std::vector<float> integrate_half;     ///< half a pixel further, one tap more;
  std::vector<float> across;             ///< across neighboring EPIs, odd.
  float contrast_energy = 0, noise_energy = 0;
  int first_shear = 0, shear_step = 0, shear_count = 0;  ///< In half pixels per view step.
  float limit = 0, min = 0, max = 0;  ///< As in TensorSearch, and what it accepts.
  bool eigenvector = false;
  /// Vertical estimates are merged into the horizontal ones, or into 0 where there are none; else
  /// stored as they are.
  bool merges = true;
  bool takes_winner = false;  ///< Merging takes the more coherent one, else as merge_orientations.
  int fusion_power = 0;
  bool squares_coherence = false;  ///< In the end.
  bool clamps = false;             ///< In the end, to [clamp_min, clamp_max].
  float clamp_min = 0, clamp_max = 0;
};

/// Estimates disparity and coherence of the views that both stacks cover, either all or one, and
/// writes every element; coherence 0 where a pixel is not valid. Camera line by camera line:
/// derivatives of all views, the best tensor of all shears, averages over neighboring EPIs.
/// Vertical EPIs are transposed when samples are read and again when results are written. Throws
/// DeviceFailure, Cancelled.
void find_orientations(const LightField& light_field, const TensorSettings& settings,
                       ViewStack<float>& disparity, ViewStack<float>& confidence,
                       const Progress& progress);

/// Leaves the estimates on the device.
void find_orientations(const LightField& light_field, const TensorSettings& settings,
                       DeviceMaps& maps, const Progress& progress);

/// What `check_lines` does; see LineCheck.
struct LineCheckSteps {
  bool chooses_sides = true;
  bool reduces_confidence = true;
};

/// Changes disparity and confidence of the views that both stacks cover, the center view among
/// them, as check_lines of the CPU. Throws DeviceFailure, Cancelled.
void check_lines(const LightField& light_field, const LineCheckSteps& steps,
                 ViewStack<float>& disparity, ViewStack<float>& confidence,
                 const Progress& progress);

/// Checks maps that are on the device.
void check_lines(const LightField& light_field, const LineCheckSteps& steps, DeviceMaps& maps,
                 const Progress& progress);

/// Replaces the disparity of rays that other views see through, as replace_occluded of the CPU;
/// both stacks cover all views. Throws DeviceFailure, Cancelled.
void replace_occluded(const LightField& light_field, ViewStack<float>& disparity,
                      const ViewStack<float>& confidence, const Progress& progress);

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
