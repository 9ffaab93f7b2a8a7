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
  ViewSelection views = ViewSelection::All;
};

struct FinishedEstimate {
  EstimatePtr estimate;    ///< With the hash of the light field.
  Interval display_range;  ///< Disparities that 98 % of the pixels of one view lie in.
};

/// Note of an estimate that somebody asked for before the method was done.
inline constexpr const char* kTakenEarly = "ended early";

/// Runs a method of the registry. What was ended early (Progress::finish_requested) says so
/// in its notes. Throws what the method throws, Unavailable for an unknown one.
[[nodiscard]] FinishedEstimate run_estimator(const LightField& light_field,
                                             const EstimateRequest& request,
                                             const Progress& progress);

/// Throws InvalidInput, naming `file`, if an estimate that was read from there has not the size and
/// views of the light field.
void check_fits(const Estimate& estimate, const LightField& light_field, const std::string& file);

/// Display range of an estimate read from a file.
[[nodiscard]] Interval display_range(const Estimate& estimate);

}  // namespace episcope
