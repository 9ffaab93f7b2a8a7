// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/global_labeling.h"

#include "engine/core/finding.h"
#include "engine/core/parallel.h"
#include "engine/cuda/layer_solver.h"
#include "engine/cuda/tv_l2.h"
#include "engine/disparity/denoise.h"
#include "engine/solvers/layered_sweep.h"
#include "engine/solvers/simplex_labeling.h"
#include "engine/solvers/tv_l2.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace episcope {

Names<Refinement> names_of(Refinement) {
  return {{Refinement::Parabola, "parabola"},
          {Refinement::Equiangular, "equiangular"},
          {Refinement::None, "none"}};
}

float sub_label_offset(float before, float here, float after, Refinement refinement) {
  const float bend = refinement == Refinement::Parabola ? before - 2 * here + after
                                                        : std::max(before, after) - here;
  if (refinement == Refinement::None || !(bend > 0)) return 0;
  return std::clamp(0.5F * (before - after) / bend, -0.5F, 0.5F);
}

namespace {

std::string labeling_note(const LiftedResult& result, double smoothness) {
  return fmt::format(fmt::runtime(result.converged ? finding_text("labeling.done")
                                                   : finding_text("labeling.early")),
                     smoothness, result.energy, result.relative_gap(), result.iterations);
}

LiftedResult solve_labels(const GlobalLabelingData& data, const Image<float>& weights,
                          double smoothness, const GlobalLabelingParameters& parameters,
                          const Progress& progress) {
  if (!data.on_device) {
    return solve_lifted_labeling(
        {data.cost, weights, smoothness},
        {.max_iterations = parameters.max_iterations, .gap = parameters.gap}, progress);
  }
  const auto report = [&](int iterations, double gap) {
    constexpr double half = 50;  // Iterations that about half of a run takes.
    progress.report(1 - std::exp2(-iterations / half));
    progress.step(labeling_gap_text(gap));
  };
  cuda::LiftedLabels found = cuda::solve_lifted({.cost = data.on_device,
                                                 .g = weights,
                                                 .smoothness = smoothness,
                                                 .max_iterations = parameters.max_iterations,
                                                 .gap = parameters.gap},
                                                report, progress);
  return {std::move(found.labels), found.iterations, found.energy, found.bound, found.converged};
}

// Solves TV-L2 of the placements.
void smooth(const GlobalLabelingData& data, Placements placed, ImageView<const float> g,
            double lambda, ImageView<float> disparity, const Progress& progress) {
  if (data.on_device) {
    cuda::solve_tv_l2(placed.disparity, placed.weight, g, lambda, progress);
    std::ranges::copy(placed.disparity, disparity.data);
    return;
  }
  TvL2Solver(disparity.height, disparity.width)
      .solve({placed.disparity, placed.weight, g, lambda}, {}, progress, disparity);
}

void settle(const GlobalLabelingData& data, const Image<int>& labels, ImageView<const float> g,
            double settling, ImageView<float> disparity, const Progress& progress) {
  const float step = data.labels[1] - data.labels[0];
  smooth(data, data.place(labels, progress.part(0, 0.5)), g, settling * step, disparity,
         progress.part(0.5, 1));
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
            {"Smoothing between labels",
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

Placements place_pixels(const Image<int>& labels,
                        const std::function<Placement(int, int, int)>& place,
                        const Progress& progress) {
  Placements placed{Image<float>(labels.height(), labels.width()),
                    Image<float>(labels.height(), labels.width())};
  parallel_for(labels.height(), progress, [&](int y) {
    for (int x = 0; x < labels.width(); ++x) {
      const Placement placement = place(y, x, labels.at(y, x));
      placed.disparity.at(y, x) = placement.disparity;
      placed.weight.at(y, x) = placement.weight;
    }
  });
  return placed;
}

void label_globally(const LightField& light_field, const GlobalLabelingData& data,
                    const GlobalLabelingParameters& parameters, Estimate& estimate,
                    const Progress& progress) {
  const double step = data.labels[1] - data.labels[0];
  const double smoothness = parameters.smoothness * data.scale;
  const Image<float> weights =
      smoothness_weights(light_field, data.view, parameters.edge_strength, data.noise_variance);
  progress.step("labeling");
  const LiftedResult result =
      solve_labels(data, weights, smoothness * step, parameters, progress.part(0, 0.85));
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
