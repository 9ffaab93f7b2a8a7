// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/view_stack.h"
#include "engine/cuda/device_data.h"

#include <cstdint>
#include <functional>
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

/// `solve_tgv_l2` on the device (engine/solvers/tv_l2.h), the same steps: `f` becomes the
/// minimizer. All have one shape. Throws DeviceFailure, Cancelled.
struct TgvTask {
  ImageView<const float> w, g;
  double lambda = 0.1;
  double bend = 2;
};
void solve_tgv_l2(Image<float>& f, const TgvTask& task, int iterations, const Progress& progress);

/// The sweeps of EPI_C; see EpiCParameters and OrderingPenalty.
struct OrderingSweeps {
  float rise = 0, fall = 0.1F, softness = 0.05F;
  int sweeps = 2;
  double lambda = 0.05;
  double weight_power = 4;
  float min_weight = 0.001F;
  double edge_strength = 15;
  int max_iterations = 24;
  double gap = 1e-4;
  /// `[view]`: whether lines that end there count.
  std::vector<std::uint8_t> counts;
  /// Told before each half of a sweep, with the largest relative gap so far.
  std::function<void(int half, double gap)> on_half;
};

/// Improves `u`, a first guess of the disparity of all views, on the device, to follow `observed`
/// with weights from `confidence` under the occlusion ordering; all cover all views. Returns the
/// largest relative duality gap of the last sweep. At `progress.finish_requested()` the views not
/// yet reached stay as they are. Throws DeviceFailure, Cancelled.
[[nodiscard]] double sweep_in_order(const LightField& light_field, const OrderingSweeps& sweeps,
                                    const ViewStack<float>& observed,
                                    const ViewStack<float>& confidence, ViewStack<float>& u,
                                    const Progress& progress);

/// Lines to neighboring views that stay within the image, and how many have D u < `limit`, px.
struct OrderedLines {
  long violations = 0, lines = 0;
};
[[nodiscard]] OrderedLines count_ordered_lines(const ViewStack<float>& disparity, float limit,
                                               const Progress& progress);

}  // namespace episcope::cuda
