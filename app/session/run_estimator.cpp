// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/run_estimator.h"

#include "engine/core/error.h"
#include "engine/disparity/registry.h"
#include "engine/render/shade.h"

namespace episcope {

FinishedEstimate run_estimator(const LightField& light_field, const EstimateRequest& request,
                               const Progress& progress) {
  const Estimator estimator = find_estimator(request.method);
  Estimate estimate =
      estimator.run(light_field, request.parameters, {.views = request.views}, progress);
  estimate.source_hash = light_field.sample_hash();
  if (progress.finish_requested() && estimator.info.iterative) {
    estimate.notes.push_back(kTakenEarly);
  }
  progress.check();
  const Interval range = display_range(estimate);
  return {std::make_shared<const Estimate>(std::move(estimate)), range};
}

void check_fits(const Estimate& estimate, const LightField& light_field, const std::string& file) {
  const auto& map = estimate.field.disparity;
  const auto size = [](int height, int width) {
    return std::to_string(width) + "×" + std::to_string(height);
  };
  if (map.height() != light_field.height() || map.width() != light_field.width()) {
    throw InvalidInput(file + ": the maps have " + size(map.height(), map.width()) +
                       " pixels, but the light field " + light_field.info().name + " has " +
                       size(light_field.height(), light_field.width()) +
                       "; open the light field that the result belongs to.");
  }
  const ViewIndex last{map.first().v + map.grid().v - 1, map.first().u + map.grid().u - 1};
  if (!light_field.grid().contains(map.first()) || !light_field.grid().contains(last)) {
    throw InvalidInput(file + ": the maps cover " + size(map.grid().v, map.grid().u) +
                       " views, but the light field " + light_field.info().name + " has " +
                       size(light_field.grid().v, light_field.grid().u) +
                       "; open the light field that the result belongs to.");
  }
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
