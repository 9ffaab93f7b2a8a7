// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/judgement.h"

#include "engine/core/error.h"

#include <utility>

namespace episcope {
namespace {

/// The view to judge: the centre if `field` covers it.
ViewIndex view_of(const DisparityField& field, const LightField& light_field) {
  const ViewIndex center = light_field.center();
  return field.contains(center) ? center : field.disparity.first();
}

void require_view(const DisparityField& estimate, ViewIndex view) {
  if (estimate.contains(view)) return;
  const auto& stack = estimate.disparity;
  throw InvalidInput("the result has " +
                     (stack.empty()
                          ? std::string("no disparity")
                          : std::to_string(stack.grid().v) + "×" + std::to_string(stack.grid().u) +
                                " views from view " + view_text(stack.first()) + " on") +
                     ", which does not cover view " + view_text(view));
}

}  // namespace

Judgement judge(const Estimate& estimate, const Scene& scene, EvaluationOptions options,
                std::optional<ViewIndex> asked_view) {
  const GroundTruth& truth = *scene.truth;
  const LightField& light_field = *scene.light_field;
  options.camera = light_field.info().camera;
  if (truth.has_layers() && !estimate.layered.foreground.empty()) {
    const ViewIndex view = asked_view.value_or(view_of(truth.foreground, light_field));
    LayeredEvaluation layers = evaluate_layers(estimate.layered, truth, view, options);
    layers.foreground.metrics = layered_metrics(layers);
    return {view, std::move(layers.foreground)};
  }
  if (!truth.has_disparity()) {
    throw InvalidInput(light_field.info().name +
                       (truth.has_layers() ? " has truth in two layers, but the result has one"
                                           : " has no true disparity to judge against"));
  }
  const ViewIndex view = asked_view.value_or(view_of(truth.field, light_field));
  if (!truth.field.contains(view)) {
    throw InvalidInput(light_field.info().name + " has no true disparity in view " +
                       view_text(view));
  }
  require_view(estimate.field, view);
  const std::map<std::string, Image<std::uint8_t>> no_regions;
  return {view, evaluate(estimate.field.view(view), truth.field.view(view),
                         view == light_field.center() ? truth.regions : no_regions, options)};
}

}  // namespace episcope
