// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/view_stack.h"
#include "engine/cuda/device_data.h"
#include "engine/disparity/kernels/shared_constants.h"

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

}  // namespace episcope::cuda
