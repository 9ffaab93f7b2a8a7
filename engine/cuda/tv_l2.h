// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/view_stack.h"
#include "engine/cuda/device_data.h"

#include <vector>

namespace episcope::cuda {

/// How maps are denoised; see DenoiseParameters and `denoise`.
struct MapDenoising {
  double lambda = 0.2;
  double weight_power = 6;
  float min_weight = 0.01F;
  double edge_strength = 20;
  float map_noise = 0;
  int max_iterations = 24;
  double gap = 1e-4;
};

/// Denoises every view of `disparity` by itself on the device, in place, with weights from
/// `confidence` and from the views; returns the relative gap of each. As many views at a time as
/// memory allows. Throws DeviceFailure, Cancelled.
[[nodiscard]] std::vector<double> denoise_maps(const LightField& light_field,
                                               const MapDenoising& denoising,
                                               const ViewStack<float>& confidence,
                                               ViewStack<float>& disparity,
                                               const Progress& progress);

/// Denoises maps that are on the device.
[[nodiscard]] std::vector<double> denoise_maps(const LightField& light_field,
                                               const MapDenoising& denoising, DeviceMaps& maps,
                                               const Progress& progress);

/// One problem of TvL2Solver on the device, with its default iterations and gap: `f` becomes the
/// minimizer. `w` and `g` have its shape. Throws DeviceFailure, Cancelled.
void solve_tv_l2(Image<float>& f, const Image<float>& w, ImageView<const float> g, double lambda,
                 const Progress& progress);

}  // namespace episcope::cuda
