// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/judge/judge.h"

#include <string>
#include <vector>

namespace episcope {

/// The numbers of a result; what there is not to judge, or to judge against, is said, not thrown.
struct Verdict {
  EvaluationPtr evaluation;  ///< By vmv2013; null if there is none.
  Metrics vmv2013;           ///< Empty without an evaluation.
  Metrics benchmark2016;     ///< Likewise; also of views smaller than two borders of 15 px.
  std::vector<std::string> notes;
  std::string problem;  ///< Why there is no evaluation, a sentence; empty = there is one.
};

/// Judges by vmv2013 alone. Throws Cancelled.
[[nodiscard]] Verdict judge_by_errors(const Estimate& estimate, const Scene& scene,
                                      const Progress& progress);
/// Judges by both protocols. Throws Cancelled.
[[nodiscard]] Verdict judge_by_both(const Estimate& estimate, const Scene& scene,
                                    const Progress& progress);

}  // namespace episcope
