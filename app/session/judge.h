// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/job_runner.h"
#include "engine/evaluation/metrics/metrics.h"

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

using EvaluationPtr = std::shared_ptr<const Evaluation>;

/// Evaluates estimates against the truth in the background and keeps the newest evaluations. For
/// the owner's thread only.
class Judge {
 public:
  /// `on_evaluated` is called on the owner's thread when an evaluation that was begun is there
  /// or failed.
  Judge(const JobRunner::Post& post, std::function<void()> on_evaluated);

  /// The evaluation if it is there; else null, and it is begun unless it is under way, failed
  /// before, or `scene` has no truth for that view.
  [[nodiscard]] EvaluationPtr find_or_begin(const EvaluationKey& key, const EstimatePtr& estimate,
                                            const std::shared_ptr<const Scene>& scene);

  /// Forgets all evaluations of an estimate; drops those that are under way.
  void forget(int estimate);
  /// Evaluations begun whose end was not told yet: the computation may be over.
  [[nodiscard]] int pending() const { return pending_; }

 private:
  struct Entry {
    EvaluationKey key;
    EvaluationPtr evaluation;  ///< Null: under way or failed.
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
