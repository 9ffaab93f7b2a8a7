// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/judge.h"

#include "app/session/judgement.h"

#include <algorithm>

namespace episcope {
namespace {

// An evaluation of 512×512 pixels takes 1.5 MB.
constexpr std::size_t kKept = 48;

bool has_both_layers(const Estimate& estimate, const GroundTruth& truth, ViewIndex view) {
  return truth.has_layers() && truth.foreground.contains(view) &&
         estimate.layered.foreground.contains(view) && estimate.layered.background.contains(view);
}

EvaluationPtr evaluate_view(const Estimate& estimate, const Scene& scene, ViewIndex view,
                            Protocol protocol) {
  const GroundTruth& truth = *scene.truth;
  if (has_both_layers(estimate, truth, view)) {
    return std::make_shared<const Evaluation>(
        judge(estimate, scene, {.protocol = protocol}, view).evaluation);
  }
  // Region masks belong to the centre view.
  const bool is_center = view == scene.light_field->center();
  const std::map<std::string, Image<std::uint8_t>> no_regions;
  return std::make_shared<const Evaluation>(
      evaluate(estimate.field.view(view), truth.field.view(view),
               is_center ? truth.regions : no_regions, {.protocol = protocol}));
}

}  // namespace

Judge::Judge(const JobRunner::Post& post, std::function<void()> on_evaluated)
    : on_evaluated_(std::move(on_evaluated)), runner_(post) {}

std::list<Judge::Entry>::iterator Judge::find(const EvaluationKey& key) {
  return std::find_if(entries_.begin(), entries_.end(),
                      [&](const Entry& entry) { return entry.key == key; });
}

EvaluationPtr Judge::find_or_begin(const EvaluationKey& key, const EstimatePtr& estimate,
                                   const std::shared_ptr<const Scene>& scene) {
  if (!estimate || !scene || !estimate->contains(key.view)) return nullptr;
  if (!scene->truth->field.contains(key.view) &&
      !has_both_layers(*estimate, *scene->truth, key.view)) {
    return nullptr;
  }
  if (const auto found = find(key); found != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, found);
    return found->evaluation;
  }
  entries_.push_front({key, nullptr});
  trim();
  ++pending_;
  runner_.start<EvaluationPtr>(
      [key, estimate, scene](const Progress& progress) {
        progress.check();
        return evaluate_view(*estimate, *scene, key.view, key.protocol);
      },
      [this, key](Outcome<EvaluationPtr> outcome) { finish(key, std::move(outcome)); });
  return nullptr;
}

void Judge::finish(const EvaluationKey& key, Outcome<EvaluationPtr> outcome) {
  --pending_;
  const auto found = find(key);
  if (found != entries_.end() && outcome.value) found->evaluation = std::move(*outcome.value);
  on_evaluated_();
}

void Judge::forget(int estimate) {
  entries_.remove_if([&](const Entry& entry) { return entry.key.estimate == estimate; });
}

void Judge::trim() {
  while (entries_.size() > kKept) entries_.pop_back();
}

}  // namespace episcope
