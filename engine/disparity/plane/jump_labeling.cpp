// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/jump_labeling.h"

#include "engine/core/light_field/channel_weight.h"
#include "engine/core/parallel/parallel.h"
#include "engine/cuda/messages/message_labeling.h"
#include "engine/solvers/messages/message_labeling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace episcope {
namespace {

float distance(const Image<float>& image, PixelIndex a, PixelIndex b) {
  float sum = 0;
  for (int c = 0; c < image.channels(); ++c) {
    const float off = image.at(a.y, a.x, c) - image.at(b.y, b.x, c);
    sum += off * off;
  }
  return std::sqrt(sum);
}

MessageResult solve(const LabelCosts& costs, const MessageProblem& problem, int passes,
                    const Progress& progress) {
  if (!costs.on_device()) return solve_by_messages(problem, passes, progress);
  cuda::MessageAnswer answer = cuda::solve_by_messages(
      {*costs.on_device(), problem.across, problem.down, problem.slope, problem.most}, passes,
      progress);
  return {std::move(answer.labels), answer.iterations, answer.energy, answer.bound};
}

}  // namespace

Schema<JumpLabelingParameters> jump_labeling_schema() {
  using P = JumpLabelingParameters;
  return Schema<P>()
      .real("smoothness", &P::smoothness,
            {"Smoothness", "Cost of a px by which neighbours differ, relative to the cap"},
            {0.001, 100})
      .real("jump", &P::jump,
            {"Jump", "No pair of neighbours pays for a larger difference than this", "px"},
            {0.001, 20})
      .real("edge_strength", &P::edge_strength,
            {"Edge strength β",
             "A pair of neighbours is weighted by exp(−β·|difference of their colours|)"},
            {0, 100})
      .real("least_weight", &P::least_weight,
            {"Least weight", "The least weight of a pair of neighbours"}, {0, 1})
      .integer("passes", &P::passes, {"Passes", "Iterations of the labeling"}, {1, 200, true});
}

PairWeights pair_weights(const LightField& lf, ViewIndex view, double beta, double least,
                         const Progress& progress) {
  const Image<float> image = lf.view_as_float(view);
  PairWeights weights{Image<float>(lf.height(), lf.width(), 1, 1.0F),
                      Image<float>(lf.height(), lf.width(), 1, 1.0F)};
  const double strength = beta * std::sqrt(channel_weight(lf.channels()));
  const auto weight = [&](PixelIndex a, PixelIndex b) {
    return static_cast<float>(std::max(least, std::exp(-strength * distance(image, a, b))));
  };
  parallel_for(lf.height(), progress, [&](int y) {
    for (int x = 0; x < lf.width(); ++x) {
      if (x + 1 < lf.width()) weights.across.at(y, x) = weight({y, x}, {y, x + 1});
      if (y + 1 < lf.height()) weights.down.at(y, x) = weight({y, x}, {y + 1, x});
    }
  });
  return weights;
}

std::string label_with_jumps(const PlaneRefinementData& data, const PairWeights& weights,
                             const JumpLabelingParameters& parameters, const Progress& progress,
                             ImageView<float> disparity) {
  progress.step("labeling");
  const std::vector<float>& labels = data.costs.stereo().labels;
  const float step = labels[1] - labels[0];
  const auto unit = static_cast<float>(parameters.smoothness * data.scale);
  const MessageProblem problem{data.costs.on_cpu(), weights.across, weights.down, unit * step,
                               unit * static_cast<float>(parameters.jump)};
  const MessageResult result =
      solve(data.costs, problem, parameters.passes, progress.part(0, 0.95));
  const Placements placed = data.costs.place(result.labels, progress.part(0.95, 1));
  for (int y = 0; y < disparity.height; ++y) {
    std::copy_n(placed.disparity.row(y), disparity.width, disparity.row(y));
  }
  return fmt::format("labeling: energy {:.6g}, gap {:.1e} after {} iterations", result.energy,
                     (result.energy - result.bound) / result.energy, result.iterations);
}

}  // namespace episcope
