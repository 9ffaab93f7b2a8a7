// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layers/two_layers_on_device.h"

#include "engine/cuda/device/host_pages.h"
#include "engine/cuda/layers/layer_solver.h"
#include "engine/cuda/line_check/line_check.h"
#include "engine/disparity/layers/double_passes.h"
#include "engine/disparity/layers/layer_score.h"
#include "engine/disparity/layers/layer_settings.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace episcope {
namespace {

cuda::LayerSmoothing smoothing_of(const LightField& lf, const EpiTwoLayerParameters& parameters,
                                  Interval range) {
  cuda::LayerSmoothing smoothing;
  smoothing.decision = parameters.decision;
  smoothing.strictness = line_strictness(lf.grid());
  smoothing.region_smoothness = parameters.region_smoothness;
  smoothing.region_iterations = kRegionIterations;
  smoothing.region_gap = kRegionGap;
  smoothing.lambda = parameters.lambda;
  smoothing.layer_smoothness = parameters.layer_smoothness;
  smoothing.weight_power = parameters.weight_power;
  smoothing.min_weight = kLeastLayerWeight;
  smoothing.edge_strength = parameters.edge_strength;
  smoothing.border_weight = kLayerBorderWeight;
  smoothing.max_iterations = parameters.stop.max_iterations;
  smoothing.gap = parameters.stop.gap;
  smoothing.min = static_cast<float>(range.min);
  smoothing.max = static_cast<float>(range.max);
  return smoothing;
}

// Maps of both layers like those of one, not yet filled.
void begin_layers(Estimate& estimate) {
  const ViewStack<float>& like = estimate.field.disparity;
  LayeredDisparity& layered = estimate.layered;
  for (ViewStack<float>* map : {&layered.foreground.disparity, &layered.background.disparity}) {
    *map = ViewStack<float>(like.grid(), like.height(), like.width(), 1, like.first());
  }
  layered.layers =
      ViewStack<std::uint8_t>(like.grid(), like.height(), like.width(), 1, like.first());
}

}  // namespace

Estimate two_layers_on_device(const LightField& lf, const EpiTwoLayerParameters& parameters,
                              const LayerSearch& search, ViewSelection views,
                              const Progress& progress) {
  Estimate estimate = begin_orientations(lf, search.single, views, progress.part(0, 0.02));
  begin_layers(estimate);
  LayeredDisparity& layered = estimate.layered;
  const cuda::LayerResults results{layered.foreground.disparity, estimate.field.disparity,
                                   layered.background.disparity, estimate.confidence,
                                   layered.layers};
  std::vector<std::future<void>> pages;
  for (ViewStack<float>* map :
       {&results.near, &results.near_again, &results.far, &results.confidence}) {
    pages.push_back(cuda::begin_pages(*map, progress));
  }
  cuda::DeviceMaps single(estimate.field.disparity), fit(estimate.field.disparity);
  cuda::find_orientations(lf, orientation_settings(lf, search.single, estimate.range), single,
                          progress.part(0.02, 0.08));
  cuda::find_orientations(lf, orientation_settings(lf, search.fit, estimate.range), fit,
                          progress.part(0.08, 0.14));
  progress.step("two orientations");
  const DevicePasses of = device_passes(lf, search.double_scales, search.doubles);
  cuda::DeviceLayers layers(lf, of.passes, of.shears, single, progress.part(0.14, 0.35));
  const LineCheck& lines = parameters.line_check;
  cuda::check_lines(lf, {lines.chooses_sides, lines.is_on}, single, progress.part(0.35, 0.4));
  progress.step("layers");
  const cuda::LayerOutcome outcome =
      cuda::solve_layers(lf, smoothing_of(lf, parameters, estimate.range), {single, layers},
                         std::move(fit), results, progress.part(0.4, 1));
  estimate.notes =
      layer_notes(outcome.doubles, layered.layers.size(), *std::ranges::max_element(outcome.gaps));
  return estimate;
}

}  // namespace episcope
