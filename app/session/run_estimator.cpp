// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/run_estimator.h"

#include "engine/disparity/registry.h"
#include "engine/render/shade.h"

namespace episcope {

FinishedEstimate run_estimator(const LightField& light_field, const EstimateRequest& request,
                               const Progress& progress) {
  const Estimator estimator = find_estimator(request.method);
  Estimate estimate = estimator.run(light_field, request.parameters, request.views, progress);
  estimate.source_hash = light_field.sample_hash();
  progress.check();
  const Interval range = display_range(estimate);
  return {std::make_shared<const Estimate>(std::move(estimate)), range};
}

Interval display_range(const Estimate& estimate) {
  const DisparityField& field = estimate.field;
  const ViewIndex first = field.disparity.first();
  const ViewIndex middle{first.v + field.disparity.grid().v / 2,
                         first.u + field.disparity.grid().u / 2};
  const DisparityView view = field.view(middle);
  return render::robust_range(view.disparity, view.valid);
}

}  // namespace episcope
