// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/judge/verdict.h"

#include "engine/core/error.h"

#include <algorithm>

namespace episcope {
namespace {

EvaluationPtr judge_by(Protocol protocol, const Estimate& estimate, const Scene& scene,
                       const Progress& progress, Verdict& verdict) {
  try {
    auto evaluation = std::make_shared<const Evaluation>(
        judge(estimate, scene, {.protocol = protocol, .progress = progress}));
    verdict.notes.insert(verdict.notes.end(), evaluation->notes.begin(), evaluation->notes.end());
    return evaluation;
  } catch (const InvalidInput& error) {
    verdict.problem = error.what();
    return nullptr;
  }
}

}  // namespace

Verdict judge_by_errors(const Estimate& estimate, const Scene& scene, const Progress& progress) {
  Verdict verdict;
  verdict.evaluation = judge_by(Protocol::Vmv2013, estimate, scene, progress, verdict);
  if (verdict.evaluation) verdict.vmv2013 = verdict.evaluation->metrics;
  return verdict;
}

Verdict judge_by_both(const Estimate& estimate, const Scene& scene, const Progress& progress) {
  Verdict verdict = judge_by_errors(estimate, scene, progress);
  const LightField& light_field = *scene.light_field;
  const int side = std::min(light_field.height(), light_field.width());
  if (!verdict.evaluation || side <= 2 * kBenchmarkBorder) return verdict;
  const auto inner = judge_by(Protocol::Benchmark2016, estimate, scene, progress, verdict);
  if (inner) verdict.benchmark2016 = inner->metrics;
  return verdict;
}

}  // namespace episcope
