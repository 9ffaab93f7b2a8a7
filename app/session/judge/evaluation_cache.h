// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/judge/judge.h"
#include "engine/core/array/pixel_rect.h"
#include "engine/core/parallel/job_runner.h"

#include <functional>
#include <list>
#include <memory>

namespace episcope {

/// Which evaluation: of what estimate, seen from where, judged how.
struct EvaluationKey {
  int estimate = 0;
  ViewIndex view;
  Protocol protocol = Protocol::Vmv2013;
  friend bool operator==(const EvaluationKey&, const EvaluationKey&) = default;
};

/// Judges estimates in the background and keeps the newest evaluations, a few of each estimate in
/// any case. For the owner's thread only.
class EvaluationCache {
 public:
  /// `on_evaluated` is called on the owner's thread when an evaluation that was begun is there
  /// or failed.
  EvaluationCache(const JobRunner::Post& post, std::function<void()> on_evaluated);

  /// The evaluation if it is there; else null, and it is begun unless it is under way, failed
  /// before, or cannot be judged (`can_judge`). Only the pixels of `part` are judged; empty = all.
  [[nodiscard]] EvaluationPtr find_or_begin(const EvaluationKey& key, const EstimatePtr& estimate,
                                            const std::shared_ptr<const Scene>& scene,
                                            const PixelRect& part = {});

  /// Forgets all evaluations of an estimate; cancels those that are under way.
  void forget(int estimate);
  /// Evaluations begun whose end was not told yet: the computation may be over.
  [[nodiscard]] int pending() const { return pending_; }

 private:
  struct Entry {
    EvaluationKey key;
    EvaluationPtr evaluation{};  ///< Null: under way or failed.
    bool is_under_way = true;
    JobId job = 0;
  };
  [[nodiscard]] std::list<Entry>::iterator find(const EvaluationKey& key);
  void finish(const EvaluationKey& key, Outcome<EvaluationPtr> outcome);
  void trim();

  std::function<void()> on_evaluated_;
  std::list<Entry> entries_;  // the newest used comes first
  int pending_ = 0;
  JobRunner runner_;
};

}  // namespace episcope
