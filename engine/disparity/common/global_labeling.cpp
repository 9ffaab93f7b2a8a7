// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/global_labeling.h"

#include "engine/core/parallel/parallel.h"
#include "engine/disparity/common/smoothness_weights.h"
#include "engine/solvers/lifted/lifted_labeling.h"
#include "engine/solvers/tv_l2/tv_l2.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace episcope {
namespace {

std::string labeling_note(const LiftedResult& result, double smoothness) {
  return fmt::format(
      "global labeling: λ {:.5g} per px, energy {:.6g}, gap {:.1e} after {} iterations{}",
      smoothness, result.energy, result.relative_gap(), result.iterations,
      result.converged ? "" : " (ended early)");
}

void settle(const GlobalLabelingData& data, const Image<int>& labels, ImageView<const float> g,
            double settling, ImageView<float> disparity, const Progress& progress) {
  const float step = data.labels[1] - data.labels[0];
  Image<float> placed(labels.height(), labels.width()), weights(labels.height(), labels.width());
  parallel_for(labels.height(), progress.part(0, 0.5), [&](int y) {
    for (int x = 0; x < labels.width(); ++x) {
      const Placement placement = data.place(y, x, labels.at(y, x));
      placed.at(y, x) = placement.disparity;
      weights.at(y, x) = placement.weight;
    }
  });
  TvL2Solver(labels.height(), labels.width())
      .solve({placed, weights, g, settling * step}, {}, progress.part(0.5, 1), disparity);
  for (int y = 0; y < labels.height(); ++y) {
    for (int x = 0; x < labels.width(); ++x) {
      const float label = data.labels[labels.at(y, x)];
      const float settled = std::clamp(disparity.at(y, x), label - step, label + step);
      disparity.at(y, x) = std::clamp(settled, data.labels.front(), data.labels.back());
    }
  }
}

}  // namespace

Schema<GlobalLabelingParameters> global_labeling_schema() {
  using P = GlobalLabelingParameters;
  return Schema<P>()
      .real("smoothness", &P::smoothness,
            {"Smoothness λ",
             "Weight of the total variation per px of disparity, relative to the mean matching "
             "cost within half a pixel of the best label (stereo) or the mean confidence weight "
             "(EPI_G), so that it depends on neither labels nor range nor contrast"},
            {0, 100})
      .real("edge_strength", &P::edge_strength,
            {"Edge strength β",
             "The total variation is weighted by exp(−β·|gradient of the view|); 0 ignores image "
             "edges, as in the paper"},
            {0, 100})
      .real("settling", &P::settling,
            {"Settling",
             "Strength of the TV-L2 smoothing that places disparities between labels afterwards, "
             "in label steps; 0 keeps the labels, as in the paper"},
            {0, 20})
      .integer("max_iterations", &P::max_iterations, {"Iterations", "Maximum iterations"},
               {1, 10000, true})
      .real("gap", &P::gap,
            {"Stop at gap",
             "The labeling stops once its energy is proven to be within this fraction of the "
             "minimum"},
            {1e-6, 0.1, true});
}

ParameterSet plain_labeling() {
  return {{"edge_strength", 0.0}, {"settling", 0.0}};
}

void label_globally(const LightField& light_field, const GlobalLabelingData& data,
                    const GlobalLabelingParameters& parameters, Estimate& estimate,
                    const Progress& progress) {
  const double step = data.labels[1] - data.labels[0];
  const double smoothness = parameters.smoothness * data.scale;
  const Image<float> weights =
      smoothness_weights(light_field, data.view, parameters.edge_strength, data.noise_variance);
  const LiftedProblem problem{data.cost, weights, smoothness * step};
  progress.step("labeling");
  const LiftedResult result = solve_lifted_labeling(
      problem, {.max_iterations = parameters.max_iterations, .gap = parameters.gap},
      progress.part(0, 0.85));
  estimate.notes.push_back(labeling_note(result, smoothness));
  estimate.field.disparity =
      ViewStack<float>({1, 1}, light_field.height(), light_field.width(), 1, data.view);
  const ImageView<float> disparity = estimate.field.disparity.view(data.view);
  if (parameters.settling > 0) {
    progress.step("settling between labels");
    settle(data, result.labels,
           smoothness_weights(light_field, data.view, parameters.edge_strength),
           parameters.settling, disparity, progress.part(0.85, 1));
  } else {
    std::transform(result.labels.begin(), result.labels.end(), disparity.data,
                   [&](int label) { return data.labels[label]; });
  }
  progress.report(1);
}

}  // namespace episcope
