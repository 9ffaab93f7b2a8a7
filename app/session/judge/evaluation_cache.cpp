// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/judge/evaluation_cache.h"

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

// An evaluation of 512×512 pixels takes 1.5 MB.
constexpr std::size_t kKept = 48;

}  // namespace

EvaluationCache::EvaluationCache(const JobRunner::Post& post, std::function<void()> on_evaluated)
    : on_evaluated_(std::move(on_evaluated)), runner_(post) {}

std::list<EvaluationCache::Entry>::iterator EvaluationCache::find(const EvaluationKey& key) {
  return std::find_if(entries_.begin(), entries_.end(),
                      [&](const Entry& entry) { return entry.key == key; });
}

EvaluationPtr EvaluationCache::find_or_begin(const EvaluationKey& key, const EstimatePtr& estimate,
                                             const std::shared_ptr<const Scene>& scene) {
  if (!estimate || !scene || !can_judge(*estimate, *scene, key.view)) return nullptr;
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
        return std::make_shared<const Evaluation>(
            judge(*estimate, *scene, {.protocol = key.protocol, .progress = progress}, key.view));
      },
      [this, key](Outcome<EvaluationPtr> outcome) { finish(key, std::move(outcome)); });
  return nullptr;
}

void EvaluationCache::finish(const EvaluationKey& key, Outcome<EvaluationPtr> outcome) {
  --pending_;
  const auto found = find(key);
  if (found != entries_.end() && outcome.value) found->evaluation = std::move(*outcome.value);
  on_evaluated_();
}

void EvaluationCache::forget(int estimate) {
  entries_.remove_if([&](const Entry& entry) { return entry.key.estimate == estimate; });
}

void EvaluationCache::trim() {
  while (entries_.size() > kKept) entries_.pop_back();
}

}  // namespace episcope
