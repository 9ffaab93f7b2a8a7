// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/denoise.h"

#include "engine/core/parallel.h"
#include "engine/disparity/edge_weights.h"
#include "engine/solvers/tv_l2.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <vector>

namespace episcope {
namespace {

std::string gap_note(const std::vector<double>& gaps) {
  char text[80];
  std::snprintf(text, sizeof text, "largest relative duality gap %.1e",
                *std::max_element(gaps.begin(), gaps.end()));
  return text;
}

// Denoises every view of `estimate` in place; returns the relative gap of each.
std::vector<double> denoise_views(const LightField& lf, const DenoiseParameters& parameters,
                                  float least_weight, Estimate& estimate,
                                  const Progress& progress) {
  ViewStack<float>& disparity = estimate.field.disparity;
  const GridShape grid = disparity.grid();
  const ViewIndex first = disparity.first();
  std::vector<double> gaps(grid.count());
  parallel_for_workers(grid.count(), progress, [&]() -> std::function<void(int)> {
    auto solver = std::make_shared<TvL2Solver>(lf.height(), lf.width());
    auto weights = std::make_shared<Image<float>>(lf.height(), lf.width());
    return [&, solver, weights](int i) {
      const ViewIndex view{first.v + i / grid.u, first.u + i % grid.u};
      fill_data_weights(estimate.confidence.view(view), {parameters.weight_power, least_weight},
                        *weights);
      const Image<float> edges = edge_weights(lf, view, parameters.edge_strength);
      const ImageView<float> map = disparity.view(view);
      const TvL2Result result =
          solver->solve({map, *weights, edges, parameters.lambda},
                        {parameters.max_iterations, parameters.gap}, progress, map);
      gaps[i] = result.energy > 0 ? result.gap / result.energy : 0;
    };
  });
  return gaps;
}

}  // namespace

void fill_data_weights(ImageView<const float> confidence, DataWeight weight,
                       Image<float>& weights) {
  const auto exponent = static_cast<float>(weight.power);
  for (int y = 0; y < confidence.height; ++y) {
    const float* r = confidence.row(y);
    float* w = weights.row(y);
    for (int x = 0; x < confidence.width; ++x) {
      const float raised = exponent == 2 ? r[x] * r[x] : std::pow(r[x], exponent);
      w[x] = std::max(raised, weight.least);
    }
  }
}

void denoise(const LightField& lf, const DenoiseParameters& parameters, Estimate& estimate,
             const Progress& progress, float least_weight) {
  progress.step("denoising");
  estimate.notes.push_back(
      gap_note(denoise_views(lf, parameters, least_weight, estimate, progress)));
}

}  // namespace episcope
