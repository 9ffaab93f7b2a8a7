// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/light_field.h"
#include "engine/disparity/common/estimator.h"

#include <string>

namespace episcope {

/// What a run of a method needs, copied when it is asked for.
struct EstimateRequest {
  std::string method;
  ParameterSet parameters;
  RunOptions options{};
};

struct FinishedEstimate {
  EstimatePtr estimate;    ///< With its provenance, the hash of the light field included.
  Interval display_range;  ///< Disparities that 98 % of the pixels of one view lie in.
};

/// Note of an estimate that was requested before the method was done.
inline constexpr const char* kTakenEarly = "ended early";
/// Whether it has that note.
[[nodiscard]] bool was_taken_early(const Estimate& estimate);

/// Runs a method of the registry. What was ended early (Progress::finish_requested) says so
/// in its notes. Throws what the method throws, Unavailable for an unknown one.
[[nodiscard]] FinishedEstimate run_estimator(const LightField& light_field,
                                             const EstimateRequest& request,
                                             const Progress& progress);
/// The same of any method.
[[nodiscard]] FinishedEstimate run_estimator(const LightField& light_field,
                                             const Estimator& estimator,
                                             const EstimateRequest& request,
                                             const Progress& progress);

}  // namespace episcope
