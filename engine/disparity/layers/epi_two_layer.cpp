// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layers/epi_two_layer.h"

#include "engine/disparity/common/invalid_pixels.h"
#include "engine/disparity/common/packed_views.h"
#include "engine/disparity/layers/double_layers.h"
#include "engine/disparity/layers/layer_search.h"
#include "engine/disparity/layers/layer_smoothing.h"
#include "engine/disparity/layers/layers_in_blocks.h"
#include "engine/disparity/layers/two_layers_on_device.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope {
namespace {

// Checks the lines of the single layer, and decides and smooths; returns the largest gap.
double solve_views(const LightField& lf, const EpiTwoLayerParameters& parameters,
                   const ViewStack<float>& fit, Estimate& estimate, const Progress& progress) {
  const PackedViews packed = pack_views(lf, progress.part(0, 0));
  check_lines(packed, parameters.line_check, estimate, progress.part(0, 0.15));
  progress.step("layers");
  return smooth_layers(lf, packed, parameters,
                       {fit, estimate.field.disparity, estimate.confidence, estimate.layered},
                       progress.part(0.15, 1));
}

// Where there are two layers, and how they are smoothed.
Schema<EpiTwoLayerParameters> layers_schema() {
  using P = EpiTwoLayerParameters;
  return Schema<P>()
      .real("decision", &P::decision,
            {"Decision",
             "Two layers are assumed where the misfit of one orientation exceeds this fraction of "
             "the misfits of one and of two orientations together"},
            {0.01, 0.99})
      .real("region_smoothness", &P::region_smoothness,
            {"Region smoothness",
             "Weight of the length of the boundary between one layer and two; regions narrower "
             "than twice this are dropped",
             "px"},
            {0.1, 100, true})
      .real("least_distance", &P::least_distance,
            {"Minimum distance", "Two layers closer to each other than this are treated as one",
             "px"},
            {0.05, 2})
      .real("lambda", &P::lambda,
            {"Smoothing λ",
             "Weight of the total variation of both layers; larger values are smoother"},
            {0.001, 10, true})
      .real("layer_smoothness", &P::layer_smoothness,
            {"Foreground smoothness",
             "Factor by which the foreground of two layers is smoothed more strongly"},
            {1, 20, true})
      .real("weight_power", &P::weight_power,
            {"Coherence exponent p",
             "The data term is weighted by coherence^p, for two layers by their confidence^p; 0 "
             "weights all pixels equally"},
            {0, 16})
      .real("edge_strength", &P::edge_strength,
            {"Edge strength β",
             "Outside two-layer regions the total variation is weighted by exp(−β·|gradient of the "
             "view|); 0 ignores image edges"},
            {0, 100});
}

}  // namespace

Schema<EpiTwoLayerParameters> epi_two_layer_schema() {
  using P = EpiTwoLayerParameters;
  return layers_schema()
      .real("double_inner_scale", &P::double_inner_scale,
            {"Inner scale, two layers",
             "Standard deviation of the Gaussian applied to the samples before second derivatives",
             "px"},
            {0, 2})
      .real("double_outer_scale", &P::double_outer_scale,
            {"Outer scale, two layers",
             "Standard deviation of the Gaussian window over which two orientations are averaged, "
             "along the EPI",
             "px"},
            {0, 3})
      .real("double_contrast", &P::double_contrast,
            {"Contrast limit, two layers", "Second derivatives above this are attenuated", "1/255"},
            {0.1, 255, true})
      .part(&P::stop, stop_schema())
      .part(&P::line_check, line_check_schema())
      .part(&P::tensor, orientation_schema())
      .search("lambda", {0.05, 0.1, 0.2, 0.4})
      .search("weight_power", {2, 6})
      .search("decision", {0.1, 0.15, 0.25});
}

std::vector<std::string> layer_notes(std::size_t doubles, std::size_t pixels, double gap) {
  const double share = 100.0 * static_cast<double>(doubles) / static_cast<double>(pixels);
  return {fmt::format("two layers in {:.1f} % of the pixels", share), gap_note(gap)};
}

std::size_t count_doubles(const ViewStack<std::uint8_t>& layers) {
  return static_cast<std::size_t>(std::count(layers.data(), layers.data() + layers.size(), 2));
}

Estimate estimate_epi_two_layer(const LightField& lf, const EpiTwoLayerParameters& parameters,
                                ViewSelection views, const Progress& progress, Device device) {
  const LayerSearch search = begin_layer_search(lf, parameters, progress.part(0, 0.1), device);
  if (device == Device::Cuda) {
    return two_layers_on_device(lf, parameters, search, views, progress.part(0.1, 1));
  }
  Estimate estimate = estimate_orientations(lf, search.single, views, progress.part(0.1, 0.15));
  const ViewStack<float> fit =
      estimate_orientations(lf, search.fit, views, progress.part(0.15, 0.2)).confidence;
  const ViewStack<float>& single = estimate.field.disparity;
  const MapBlock whole{{single.first(), single.grid()}, 0, lf.height()};
  DoubleLayers layers = measure_double_layers(lf, search.double_scales, search.doubles, whole,
                                              progress.part(0.2, 0.4));
  LayeredDisparity& layered = estimate.layered;
  layered.foreground.disparity = std::move(layers.near);
  layered.background.disparity = std::move(layers.far);
  layered.layers = std::move(layers.confidence);
  clear_invalid(lf, layered.layers);
  const double gap = solve_views(lf, parameters, fit, estimate, progress.part(0.4, 0.98));
  estimate.notes = layer_notes(count_doubles(layered.layers), layered.layers.size(), gap);
  clamp_layers({fit, estimate.field.disparity, estimate.confidence, layered}, estimate.range,
               progress.part(0.98, 1));
  return estimate;
}

Estimator epi_two_layer_estimator() {
  return make_estimator<EpiTwoLayerParameters>(
      {.id = "epi_two_layer",
       .name = "EPI_TWO_LAYER",
       .summary = "Two superimposed orientations on epipolar plane images: transparent and "
                  "reflective surfaces",
       .reference = "Wanner and Goldluecke 2013 [Ano13]",
       .all_views = true,
       .iterative = true,
       .revision = 6,
       .devices = {Device::Cpu, Device::Cuda}},
      epi_two_layer_schema(), estimate_epi_two_layer, two_layers_in_blocks);
}

}  // namespace episcope
