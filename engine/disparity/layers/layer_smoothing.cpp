// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layers/layer_smoothing.h"

#include "engine/core/parallel/parallel.h"
#include "engine/disparity/common/smoothness_weights.h"
#include "engine/disparity/layers/layer_score.h"
#include "engine/disparity/layers/layer_settings.h"
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

class ViewSmoother {
 public:
  ViewSmoother(const LightField& lf, const PackedViews& packed,
               const EpiTwoLayerParameters& parameters, const Progress& progress)
      : lf_(lf),
        parameters_(parameters),
        progress_(progress),
        score_(packed, lf.grid(), parameters.decision),
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

void ViewSmoother::find_region(ViewIndex index, const LayeredView& view) {
  score_.judge(index, {view.fit, view.single, view.near, view.far, view.layers}, space_.data.view(),
               space_.weight.view());
  segment_binary(space_.solver, {space_.data, space_.weight, {}, parameters_.region_smoothness},
                 {kRegionIterations, kRegionGap}, progress_, space_.edge.view(), region_.view());
}

// Of either layer's data.
void ViewSmoother::find_weights(const LayeredView& view) {
  Image<float>& trust = space_.coherence;
  for (std::size_t i = 0; i < region_.size(); ++i) {
    trust.data()[i] = region_.data()[i] != 0 ? confidence(view, i) : view.coherence.data[i];
  }
  fill_data_weights(trust, {parameters_.weight_power, kLeastLayerWeight}, space_.weight);
}

double ViewSmoother::solve_layer(double lambda, ImageView<float> result) {
  return space_.solver
      .solve({space_.data, space_.weight, space_.edge, lambda},
             {parameters_.stop.max_iterations, parameters_.stop.gap}, progress_, result)
      .relative_gap();
}

double ViewSmoother::solve_background(const Image<float>& edges, const LayeredView& view) {
  for (std::size_t i = 0; i < region_.size(); ++i) {
    const bool is_double = region_.data()[i] != 0;
    space_.data.data()[i] = is_double ? view.far.data[i] : view.single.data[i];
    // Image edges of the region are those of both layers: they tell of neither.
    space_.edge.data()[i] = is_double ? 1 : edges.data()[i];
  }
  return solve_layer(parameters_.lambda, view.far);
}

double ViewSmoother::solve_foreground(const Image<float>& edges, const LayeredView& view) {
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
void ViewSmoother::finish(const LayeredView& view) {
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

double ViewSmoother::solve(ViewIndex index, const LayeredView& view) {
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

}  // namespace

double smooth_layers(const LightField& lf, const PackedViews& packed,
                     const EpiTwoLayerParameters& parameters, const LayeredMaps& maps,
                     const Progress& progress) {
  LayeredDisparity& layered = maps.layered;
  const GridShape grid = layered.layers.grid();
  const ViewIndex first = layered.layers.first();
  std::vector<double> gaps(grid.count());
  parallel_for_workers(grid.count(), progress, [&] {
    return [&, smoother = ViewSmoother(lf, packed, parameters, progress)](int i) mutable {
      const ViewIndex view = grid.view_at(i, first);
      gaps[i] = smoother.solve(
          view, {maps.fit.view(view), maps.single.view(view), maps.coherence.view(view),
                 layered.foreground.disparity.view(view), layered.background.disparity.view(view),
                 layered.layers.view(view)});
    };
  });
  return *std::ranges::max_element(gaps);
}

void clamp_layers(const LayeredMaps& maps, Interval range, const Progress& progress) {
  const auto low = static_cast<float>(range.min);
  const auto high = static_cast<float>(range.max);
  ViewStack<float>& field = maps.single;
  ViewStack<float>& near = maps.layered.foreground.disparity;
  ViewStack<float>& far = maps.layered.background.disparity;
  parallel_for(field.grid().count(), progress, [&](int view) {
    const std::size_t begin = view * field.view_size();
    for (std::size_t i = begin; i < begin + field.view_size(); ++i) {
      far.data()[i] = std::clamp(far.data()[i], low, high);
      near.data()[i] = std::clamp(near.data()[i], low, high);
      field.data()[i] = near.data()[i];
    }
  });
}

}  // namespace episcope
