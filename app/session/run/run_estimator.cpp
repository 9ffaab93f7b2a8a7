// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/run/run_estimator.h"

#include "app/session/scene/scene_range.h"
#include "engine/disparity/registry.h"

#include <algorithm>

namespace episcope {

FinishedEstimate run_estimator(const LightField& light_field, const EstimateRequest& request,
                               const Progress& progress) {
  return run_estimator(light_field, find_estimator(request.method), request, progress);
}

bool was_taken_early(const Estimate& estimate) {
  return std::ranges::find(estimate.notes, kTakenEarly) != estimate.notes.end();
}

FinishedEstimate run_estimator(const LightField& light_field, const Estimator& estimator,
                               const EstimateRequest& request, const Progress& progress) {
  auto estimate = std::make_shared<Estimate>(
      estimator.run(light_field, request.parameters, request.options, progress));
  estimate->source_hash = light_field.sample_hash();
  if (progress.finish_requested() && estimator.info.iterative) {
    estimate->notes.push_back(kTakenEarly);
  }
  progress.check();
  const Interval range = display_range(*estimate);
  return {std::move(estimate), range};
}

}  // namespace episcope
