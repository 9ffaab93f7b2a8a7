// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/edge_probability.h"

#include "engine/core/error.h"
#include "engine/core/light_field/gradient_magnitude.h"
#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope {
namespace {

// Length of the disparity's forward differences, 0 where one of the pixels is invalid.
float disparity_jump(const DisparityView& map, int y, int x) {
  const int right = std::min(x + 1, map.disparity.width - 1);
  const int below = std::min(y + 1, map.disparity.height - 1);
  if (!map.is_valid(y, x) || !map.is_valid(y, right) || !map.is_valid(below, x)) return 0;
  const float d = map.disparity.at(y, x);
  return std::hypot(map.disparity.at(y, right) - d, map.disparity.at(below, x) - d);
}

void fill_view(const LightField& lf, ViewIndex view, const DisparityField& disparity,
               const EdgeParameters& parameters, ImageView<float> out) {
  gradient_magnitude(lf, view, out);
  const auto beta = static_cast<float>(parameters.image);
  const auto gamma = static_cast<float>(parameters.disparity);
  const bool has_disparity = gamma > 0 && disparity.contains(view);
  const DisparityView map = has_disparity ? disparity.view(view) : DisparityView{};
  for (int y = 0; y < out.height; ++y) {
    float* const row = out.row(y);
    for (int x = 0; x < out.width; ++x) {
      const float jump = has_disparity ? gamma * disparity_jump(map, y, x) : 0;
      row[x] = 1 - std::exp(-beta * row[x] - jump);
    }
  }
}

void check_sizes(const LightField& lf, const DisparityField& disparity) {
  if (disparity.empty() ||
      (disparity.disparity.height() == lf.height() && disparity.disparity.width() == lf.width())) {
    return;
  }
  throw InvalidInput("edges need disparities of the size of the light field");
}

}  // namespace

Image<float> edge_probability(const LightField& light_field, ViewIndex view,
                              const DisparityField& disparity, const EdgeParameters& parameters) {
  check_sizes(light_field, disparity);
  Image<float> edges(light_field.height(), light_field.width());
  fill_view(light_field, view, disparity, parameters, edges.view());
  return edges;
}

ViewStack<float> edge_probabilities(const LightField& light_field, const DisparityField& disparity,
                                    const EdgeParameters& parameters, const Progress& progress) {
  return edge_probabilities(light_field, {{0, 0}, light_field.grid()}, disparity, parameters,
                            progress);
}

ViewStack<float> edge_probabilities(const LightField& light_field, ViewRectangle views,
                                    const DisparityField& disparity,
                                    const EdgeParameters& parameters, const Progress& progress) {
  check_sizes(light_field, disparity);
  ViewStack<float> edges(views.grid, light_field.height(), light_field.width(), 1, views.first);
  parallel_for(views.grid.count(), progress, [&](int i) {
    const ViewIndex view = views.grid.view_at(i, views.first);
    fill_view(light_field, view, disparity, parameters, edges.view(view));
  });
  return edges;
}

Image<float> larger_edge_probability(ImageView<const float> edge_probability) {
  const auto& edge = edge_probability;
  Image<float> larger(edge.height, edge.width);
  for (int y = 0; y < edge.height; ++y) {
    for (int x = 0; x < edge.width; ++x) {
      larger.at(y, x) = std::max(edge.at(y, x), edge.at(y, x, edge.channels - 1));
    }
  }
  return larger;
}

Image<float> boundary_weights(ImageView<const float> edge_probability) {
  Image<float> weights = larger_edge_probability(edge_probability);
  for (float& weight : weights) weight = std::clamp(1 - weight, kMinBoundaryWeight, 1.0F);
  return weights;
}

}  // namespace episcope
