// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layers/epi_two_layer.h"

#include "engine/core/parallel/parallel.h"
#include "engine/disparity/common/invalid_pixels.h"
#include "engine/disparity/common/smoothness_weights.h"
#include "engine/disparity/layers/double_layers.h"
#include "engine/disparity/layers/layer_range.h"
#include "engine/disparity/layers/layer_score.h"
#include "engine/disparity/layers/layer_settings.h"
#include "engine/disparity/layers/two_layers_on_device.h"
#include "engine/solvers/simplex/binary_segmentation.h"

#include <algorithm>
#include <vector>

namespace episcope {
namespace {

// What one thread needs to solve a view.
struct Workspace {
  TvL2Solver solver;
  Image<float> data, weight, edge, coherence;

  Workspace(int height, int width)
      : solver(height, width),
        data(height, width),
        weight(height, width),
        edge(height, width),
        coherence(height, width) {}
};

// One view: raw maps, replaced by the results.
struct LayeredView {
  ImageView<const float> fit;  // coherence before lines were checked
  ImageView<float> single, coherence;
  ImageView<float> near, far;
  ImageView<std::uint8_t> layers;  // raw: confidence in 1/255
};

class ViewSolver {
 public:
  ViewSolver(const LightField& lf, const PackedViews& packed,
             const EpiTwoLayerParameters& parameters, const Progress& progress)
      : lf_(lf),
        parameters_(parameters),
        progress_(progress),
        score_(packed, parameters.decision),
        space_(lf.height(), lf.width()) {}

  // Returns the largest relative gap of its solutions.
  double solve(ViewIndex index, const LayeredView& view);

 private:
  void find_region(ViewIndex index, const LayeredView& view);
  void find_weights(const LayeredView& view);
  double solve_background(const Image<float>& edges, const LayeredView& view);
  double solve_foreground(const Image<float>& edges, const LayeredView& view);
  double solve_layer(double lambda, ImageView<float> result);
  void finish(const LayeredView& view);
  [[nodiscard]] float confidence(const LayeredView& view, std::size_t i) const {
    return static_cast<float>(view.layers.data[i]) / 255;
  }

  const LightField& lf_;
  const EpiTwoLayerParameters& parameters_;
  const Progress& progress_;
  LayerScore score_;
  Workspace space_;
  Image<std::uint8_t> region_;
};

void ViewSolver::find_region(ViewIndex index, const LayeredView& view) {
  score_.judge(index, {view.fit, view.single, view.near, view.far, view.layers}, space_.data.view(),
               space_.weight.view());
  segment_binary(space_.solver, {space_.data, space_.weight, {}, parameters_.region_smoothness},
                 {kRegionIterations, kRegionGap}, progress_, space_.edge.view(), region_.view());
}

// Of either layer's data.
void ViewSolver::find_weights(const LayeredView& view) {
  Image<float>& trust = space_.coherence;
  for (std::size_t i = 0; i < region_.size(); ++i) {
    trust.data()[i] = region_.data()[i] != 0 ? confidence(view, i) : view.coherence.data[i];
  }
  fill_data_weights(trust, {parameters_.weight_power, kLeastLayerWeight}, space_.weight);
}

double ViewSolver::solve_layer(double lambda, ImageView<float> result) {
  return space_.solver
      .solve({space_.data, space_.weight, space_.edge, lambda},
             {parameters_.stop.max_iterations, parameters_.stop.gap}, progress_, result)
      .relative_gap();
}

double ViewSolver::solve_background(const Image<float>& edges, const LayeredView& view) {
  for (std::size_t i = 0; i < region_.size(); ++i) {
    const bool is_double = region_.data()[i] != 0;
    space_.data.data()[i] = is_double ? view.far.data[i] : view.single.data[i];
    // Image edges of the region are those of both layers: they tell of neither.
    space_.edge.data()[i] = is_double ? 1 : edges.data()[i];
  }
  return solve_layer(parameters_.lambda, view.far);
}

double ViewSolver::solve_foreground(const Image<float>& edges, const LayeredView& view) {
  const auto factor = static_cast<float>(std::max(parameters_.layer_smoothness, 1.0));
  for (int y = 0; y < region_.height(); ++y) {
    const std::uint8_t* here = region_.row(y);
    const std::uint8_t* below = region_.row(std::min(y + 1, region_.height() - 1));
    for (int x = 0; x < region_.width(); ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * region_.width() + x;
      const bool is_double = here[x] != 0;
      const int right = std::min(x + 1, region_.width() - 1);
      const bool is_border = here[right] != here[x] || below[x] != here[x];
      space_.data.data()[i] = is_double ? view.near.data[i] : view.single.data[i];
      space_.edge.data()[i] = is_border   ? kLayerBorderWeight
                              : is_double ? 1
                                          : edges.data()[i] / factor;
    }
  }
  return solve_layer(parameters_.lambda * factor, view.near);
}

// Orders the layers, and writes confidence and number of layers.
void ViewSolver::finish(const LayeredView& view) {
  for (std::size_t i = 0; i < region_.size(); ++i) {
    float& near = view.near.data[i];
    float& far = view.far.data[i];
    if (region_.data()[i] == 0) {
      near = far;
      view.layers.data[i] = 1;
      continue;
    }
    if (near < far) near = far = 0.5F * (near + far);
    view.coherence.data[i] = confidence(view, i);
    view.layers.data[i] = 2;
  }
}

double ViewSolver::solve(ViewIndex index, const LayeredView& view) {
  if (region_.empty()) region_ = Image<std::uint8_t>(lf_.height(), lf_.width());
  find_region(index, view);
  find_weights(view);
  const Image<float> edges = smoothness_weights(lf_, index, parameters_.edge_strength);
  double gap = 0;
  // The background last: outside the region it is what both layers hold.
  if (std::any_of(region_.begin(), region_.end(), [](std::uint8_t m) { return m != 0; })) {
    gap = solve_foreground(edges, view);
  }
  gap = std::max(gap, solve_background(edges, view));
  finish(view);
  return gap;
}

// Replaces the raw maps in `estimate` by the results.
std::vector<double> solve_on_cpu(const LightField& lf, const PackedViews& packed,
                                 const EpiTwoLayerParameters& parameters,
                                 const ViewStack<float>& fit, Estimate& estimate,
                                 const Progress& progress) {
  LayeredDisparity& layered = estimate.layered;
  const GridShape grid = layered.layers.grid();
  const ViewIndex first = layered.layers.first();
  std::vector<double> gaps(grid.count());
  parallel_for_workers(grid.count(), progress, [&] {
    return [&, solver = ViewSolver(lf, packed, parameters, progress)](int i) mutable {
      const ViewIndex view = grid.view_at(i, first);
      gaps[i] = solver.solve(
          view, {fit.view(view), estimate.field.disparity.view(view),
                 estimate.confidence.view(view), layered.foreground.disparity.view(view),
                 layered.background.disparity.view(view), layered.layers.view(view)});
    };
  });
  return gaps;
}

// Checks the lines of the single layer, and decides and smooths.
void solve_views(const LightField& lf, const EpiTwoLayerParameters& parameters,
                 const ViewStack<float>& fit, Estimate& estimate, const Progress& progress) {
  const PackedViews packed = pack_views(lf, progress.part(0, 0));
  check_lines(packed, parameters.line_check, estimate, progress.part(0, 0.15));
  progress.step("layers");
  const std::vector<double> gaps =
      solve_on_cpu(lf, packed, parameters, fit, estimate, progress.part(0.15, 1));
  estimate.notes = layer_notes(gaps, estimate.layered.layers);
}

// Overshoot that the tensors left in, and the foreground as the single map for methods with one
// layer.
void clamp_layers(Estimate& estimate, const Progress& progress) {
  const auto low = static_cast<float>(estimate.range.min);
  const auto high = static_cast<float>(estimate.range.max);
  ViewStack<float>& field = estimate.field.disparity;
  ViewStack<float>& near = estimate.layered.foreground.disparity;
  ViewStack<float>& far = estimate.layered.background.disparity;
  parallel_for(field.grid().count(), progress, [&](int view) {
    const std::size_t begin = view * field.view_size();
    for (std::size_t i = begin; i < begin + field.view_size(); ++i) {
      far.data()[i] = std::clamp(far.data()[i], low, high);
      near.data()[i] = std::clamp(near.data()[i], low, high);
      field.data()[i] = near.data()[i];
    }
  });
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

Estimate estimate_epi_two_layer(const LightField& lf, const EpiTwoLayerParameters& parameters,
                                ViewSelection views, const Progress& progress, Device device) {
  EpiLParameters tensor = parameters.tensor;
  const TensorScales scales = scales_of_layers(parameters);
  tensor.range = search_layer_range(lf, tensor, scales, progress.part(0, 0.1), device);
  if (device == Device::Cuda) {
    return two_layers_on_device(lf, parameters, tensor, views, progress.part(0.1, 1));
  }
  Estimate estimate = estimate_orientations(lf, tensor, views, progress.part(0.1, 0.15));
  tensor.cross_scale = kCrossScaleOfLayers;
  const ViewStack<float> fit =
      estimate_orientations(lf, tensor, views, progress.part(0.15, 0.2)).confidence;
  const ViewStack<float>& single = estimate.field.disparity;
  DoubleLayers layers =
      measure_double_layers(lf, scales, layer_search(parameters, estimate.range), single.grid(),
                            single.first(), progress.part(0.2, 0.4));
  estimate.layered.foreground.disparity = std::move(layers.near);
  estimate.layered.background.disparity = std::move(layers.far);
  estimate.layered.layers = std::move(layers.confidence);
  clear_invalid(lf, estimate.layered.layers);
  solve_views(lf, parameters, fit, estimate, progress.part(0.4, 0.98));
  clamp_layers(estimate, progress.part(0.98, 1));
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
      epi_two_layer_schema(), estimate_epi_two_layer);
}

}  // namespace episcope
