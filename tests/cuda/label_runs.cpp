// SPDX-License-Identifier: BSD-3-Clause
#include "tests/cuda/label_runs.h"

#include "engine/core/light_field.h"
#include "engine/labeling/regularizer.h"
#include "tests/engine/labeling/noisy_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace episcope::cuda_tests {
namespace {

constexpr double kMistaken = 0.3;

struct Input {
  LabelProbabilities probabilities;
  ViewStack<float> edges;
};

ViewStack<float> edges_of(const LightField& lf) {
  ViewStack<float> edges(lf.grid(), lf.height(), lf.width());
  for (int i = 0; i < lf.grid().count(); ++i) {
    gradient_magnitude(lf, edges.view_at(i), edges.view(edges.view_at(i)));
  }
  std::transform(edges.data(), edges.data() + edges.size(), edges.data(),
                 [](float gradient) { return 1 - std::exp(-25 * gradient); });
  return edges;
}

std::vector<std::uint8_t> bytes_of(const ViewStack<std::int32_t>& labels) {
  std::vector<std::uint8_t> bytes(labels.size());
  std::transform(labels.data(), labels.data() + labels.size(), bytes.begin(),
                 [](std::int32_t label) { return static_cast<std::uint8_t>(label); });
  return bytes;
}

LabelRun smoothing(const Scene& scene, const std::shared_ptr<const Input>& input,
                   Regularizer regularizer) {
  LabelRun each;
  each.title =
      fmt::format("labels {}, {} labels", name_of(regularizer), input->probabilities.ids.size());
  each.share = kLabelShare;
  each.run = [&scene, input, regularizer](Device device) {
    RayLabelingParameters parameters;
    parameters.device = device;
    parameters.smoothness = 4;
    const RayLabelingInput rays{&input->probabilities, &scene.truth->field, &input->edges,
                                scene.light_field.get()};
    return bytes_of(label_rays(rays, regularizer, parameters, Progress()).labels);
  };
  return each;
}

}  // namespace

std::vector<LabelRun> label_runs(const Scene& scene) {
  const auto input = std::make_shared<const Input>(
      Input{test::mistaken(scene.truth->labels, kMistaken), edges_of(*scene.light_field)});
  std::vector<LabelRun> runs;
  runs.push_back(smoothing(scene, input, Regularizer::View));
  runs.push_back(smoothing(scene, input, Regularizer::Rayspace));
  LabelRun whole = whole_labeler(scene);
  if (whole.run) runs.push_back(std::move(whole));
  return runs;
}

}  // namespace episcope::cuda_tests
