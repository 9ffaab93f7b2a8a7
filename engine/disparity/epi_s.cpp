// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi_s.h"

#include "engine/core/parallel.h"
#include "engine/disparity/edge_weights.h"
#include "engine/solvers/tv_l2.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

namespace episcope {
namespace {

// No pixel is given up entirely: the solution stays unique.
constexpr float kLeastWeight = 0.01F;

void fill_weights(ImageView<const float> coherence, double power, Image<float>& weights) {
  const auto exponent = static_cast<float>(power);
  for (int y = 0; y < coherence.height; ++y) {
    const float* r = coherence.row(y);
    float* w = weights.row(y);
    for (int x = 0; x < coherence.width; ++x) {
      const float raised = exponent == 2 ? r[x] * r[x] : std::pow(r[x], exponent);
      w[x] = std::max(raised, kLeastWeight);
    }
  }
}

std::string gap_note(const std::vector<double>& gaps) {
  char text[80];
  std::snprintf(text, sizeof text, "largest relative duality gap %.1e",
                *std::max_element(gaps.begin(), gaps.end()));
  return text;
}

// Denoises every view of `estimate` in place; returns the relative gap of each.
std::vector<double> denoise(const LightField& lf, const EpiSParameters& parameters,
                            Estimate& estimate, const Progress& progress) {
  ViewStack<float>& disparity = estimate.field.disparity;
  const GridShape grid = disparity.grid();
  const ViewIndex first = disparity.first();
  std::vector<double> gaps(grid.count());
  parallel_for_workers(grid.count(), progress, [&]() -> std::function<void(int)> {
    auto solver = std::make_shared<TvL2Solver>(lf.height(), lf.width());
    auto weights = std::make_shared<Image<float>>(lf.height(), lf.width());
    return [&, solver, weights](int i) {
      const ViewIndex view{first.v + i / grid.u, first.u + i % grid.u};
      fill_weights(estimate.confidence.view(view), parameters.weight_power, *weights);
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

Schema<EpiSParameters> epi_s_schema() {
  using P = EpiSParameters;
  Schema<P> schema;
  schema
      .real("lambda", &P::lambda,
            {"Smoothing λ", "Weight of the total variation: larger is smoother"}, {0.001, 10, true})
      .real("weight_power", &P::weight_power,
            {"Trust in coherence",
             "Data is weighted by coherence^p; 0 trusts every pixel alike, as in the paper"},
            {0, 16})
      .real(
          "edge_strength", &P::edge_strength,
          {"Edge strength β",
           "The variation is weighted by exp(−β·|gradient of the view|); 0 ignores image edges, as "
           "in the paper"},
          {0, 100})
      .integer("max_iterations", &P::max_iterations,
               {"Iterations", "At most so many of the denoising, at full resolution"},
               {1, 2000, true})
      .real("gap", &P::gap,
            {"Stop at gap",
             "The denoising stops early once the duality gap is this share of the energy"},
            {1e-6, 0.1, true});
  add_epi_l_parameters(schema);
  schema.search("lambda", {0.05, 0.1, 0.2, 0.4, 0.8})
      .search("weight_power", {0, 2, 8, 16})
      .search("edge_strength", {0, 10, 30});
  return schema;
}

Estimate estimate_epi_s(const LightField& lf, const EpiSParameters& parameters, ViewSelection views,
                        const Progress& progress) {
  Estimate estimate = estimate_orientations(lf, parameters, views, progress.part(0, 0.4));
  progress.step("denoising");
  const std::vector<double> gaps = denoise(lf, parameters, estimate, progress.part(0.4, 0.98));
  clamp_to_range(estimate, progress.part(0.98, 1));
  estimate.notes.push_back(gap_note(gaps));
  return estimate;
}

Estimator epi_s_estimator() {
  return make_estimator<EpiSParameters>(
      {"epi_s", "EPI_S", "EPI_L, denoised view by view with total variation (TV-L2)",
       "Wanner and Goldluecke 2013 [WG13]", true},
      epi_s_schema(), estimate_epi_s);
}

}  // namespace episcope
