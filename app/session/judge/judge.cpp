// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/judge/judge.h"

#include "engine/core/error.h"

#include <cmath>
#include <utility>

namespace episcope {
namespace {

ViewIndex view_of(const DisparityField& field, const LightField& light_field) {
  const ViewIndex center = light_field.center();
  return field.empty() || field.contains(center) ? center : field.disparity.first();
}

// Whether both are in two layers. The truth of such a scene may have a single map as well.
bool compares_layers(const Estimate& estimate, const GroundTruth& truth) {
  return truth.has_layers() && !estimate.layered.foreground.empty() &&
         !estimate.layered.background.empty();
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

void require_truth(const Scene& scene, ViewIndex view) {
  const GroundTruth& truth = *scene.truth;
  const std::string& name = scene.light_field->info().name;
  if (!truth.has_disparity()) {
    throw InvalidInput(name + (truth.has_layers()
                                   ? " has truth in two layers, but the result has one"
                                   : " has no true disparity to judge against"));
  }
  if (!truth.field.contains(view)) {
    throw InvalidInput(name + " has no true disparity in view " + view_text(view));
  }
}

/// Which pixels of `asked` (empty = all) both the light field and maps that lack a border show;
/// empty = all that the light field shows.
Image<std::uint8_t> covered(const Estimate& estimate, const LightField& light_field, ViewIndex view,
                            ImageView<const std::uint8_t> asked) {
  const int border = estimate.border_px;
  if (border <= 0 && asked.empty()) return {};
  const auto shown = light_field.valid_of(view);
  Image<std::uint8_t> mask(light_field.height(), light_field.width());
  for (int y = border; y < mask.height() - border; ++y) {
    for (int x = border; x < mask.width() - border; ++x) {
      const bool is_asked = asked.empty() || asked.at(y, x) != 0;
      mask.at(y, x) = is_asked && (shown.empty() || shown.at(y, x) != 0) ? 1 : 0;
    }
  }
  return mask;
}

}  // namespace

ViewIndex judged_view(const Scene& scene) {
  const GroundTruth& truth = *scene.truth;
  return view_of(truth.has_disparity() ? truth.field : truth.foreground, *scene.light_field);
}

bool can_judge(const Estimate& estimate, const Scene& scene, ViewIndex view) {
  const GroundTruth& truth = *scene.truth;
  if (compares_layers(estimate, truth)) {
    return truth.foreground.contains(view) && truth.background.contains(view) &&
           estimate.layered.foreground.contains(view) && estimate.layered.background.contains(view);
  }
  return truth.field.contains(view) && estimate.field.contains(view);
}

Evaluation judge(const Estimate& estimate, const Scene& scene, EvaluationOptions options,
                 std::optional<ViewIndex> asked_view) {
  const GroundTruth& truth = *scene.truth;
  const LightField& light_field = *scene.light_field;
  const ViewIndex view = asked_view.value_or(judged_view(scene));
  options.camera = light_field.info().camera;
  const Image<std::uint8_t> part = covered(estimate, light_field, view, options.shown);
  options.shown = part.empty() ? light_field.valid_of(view) : part.view();
  Evaluation evaluation;
  if (compares_layers(estimate, truth)) {
    LayeredEvaluation layers = evaluate_layers(estimate.layered, truth, view, options);
    layers.foreground.metrics = layered_metrics(layers);
    evaluation = std::move(layers.foreground);
  } else {
    require_truth(scene, view);
    require_view(estimate.field, view);
    const std::map<std::string, Image<std::uint8_t>> no_regions;
    const bool is_center = view == light_field.center();
    options.high_res = is_center ? truth.high_res.get() : nullptr;
    options.stratified = truth.stratified;
    evaluation = evaluate(estimate.field.view(view), truth.field.view(view),
                          is_center ? truth.regions : no_regions, options);
  }
  if (options.protocol == Protocol::Benchmark2016 && estimate.seconds > 0) {
    evaluation.metrics.emplace_back("runtime_log", std::log10(estimate.seconds));
  }
  return evaluation;
}

}  // namespace episcope
