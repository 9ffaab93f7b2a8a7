// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/judge/evaluation_cache.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace episcope {
namespace {

// An evaluation of 512×512 pixels takes 1.5 MB.
constexpr std::size_t kKept = 48;
// Of each estimate, however many there are: what tables and pictures ask for again and again, by
// either protocol and in the view that is looked at.
constexpr std::ptrdiff_t kKeptOfEach = 3;

// 1 in the part; empty for an empty part.
Image<std::uint8_t> mask_of(const PixelRect& part, const LightField& light_field) {
  if (part.empty()) return {};
  Image<std::uint8_t> mask(light_field.height(), light_field.width());
  for (int y = part.y0; y < part.y1; ++y) {
    for (int x = part.x0; x < part.x1; ++x) mask.at(y, x) = 1;
  }
  return mask;
}

}  // namespace

EvaluationCache::EvaluationCache(const JobRunner::Post& post, std::function<void()> on_evaluated)
    : on_evaluated_(std::move(on_evaluated)), runner_(post) {}

std::list<EvaluationCache::Entry>::iterator EvaluationCache::find(const EvaluationKey& key) {
  return std::find_if(entries_.begin(), entries_.end(),
                      [&](const Entry& entry) { return entry.key == key; });
}

EvaluationPtr EvaluationCache::find_or_begin(const EvaluationKey& key, const EstimatePtr& estimate,
                                             const std::shared_ptr<const Scene>& scene,
                                             const PixelRect& part) {
  if (!estimate || !scene || !can_judge(*estimate, *scene, key.view)) return nullptr;
  if (const auto found = find(key); found != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, found);
    return found->evaluation;
  }
  entries_.push_front({.key = key});
  trim();
  ++pending_;
  entries_.front().job = runner_.start<EvaluationPtr>(
      [key, estimate, scene, part](const Progress& progress) {
        progress.check();
        const Image<std::uint8_t> asked = mask_of(part, *scene->light_field);
        EvaluationOptions options{.protocol = key.protocol, .progress = progress};
        if (!part.empty()) options.shown = asked.view();
        return std::make_shared<const Evaluation>(
            judge(*estimate, *scene, std::move(options), key.view));
      },
      [this, key](Outcome<EvaluationPtr> outcome) { finish(key, std::move(outcome)); });
  return nullptr;
}

void EvaluationCache::finish(const EvaluationKey& key, Outcome<EvaluationPtr> outcome) {
  --pending_;
  if (const auto found = find(key); found != entries_.end()) {
    found->is_under_way = false;
    if (outcome.value) found->evaluation = std::move(*outcome.value);
  }
  on_evaluated_();
}

void EvaluationCache::forget(int estimate) {
  entries_.remove_if([&](const Entry& entry) {
    if (entry.key.estimate != estimate) return false;
    runner_.cancel(entry.job);
    return true;
  });
}

void EvaluationCache::trim() {
  const auto count_of = [&](int estimate) {
    return std::ranges::count(entries_, estimate,
                              [](const Entry& entry) { return entry.key.estimate; });
  };
  for (auto end = entries_.end(); entries_.size() > kKept && end != entries_.begin();) {
    const auto oldest = std::prev(end);
    const bool stays = oldest->is_under_way || count_of(oldest->key.estimate) <= kKeptOfEach;
    end = stays ? oldest : entries_.erase(oldest);
  }
}

}  // namespace episcope
