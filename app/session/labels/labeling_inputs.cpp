// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/labels/labeling_inputs.h"

#include "app/session/run/read_result.h"
#include "app/session/run/result_reading.h"
#include "app/session/run/run_estimator.h"
#include "engine/core/error.h"
#include "engine/io/archive/companions.h"

namespace episcope {
namespace {

void require_all_views(const DisparityField& field, const LightField& lf, const std::string& what) {
  if (field.disparity.grid() == lf.grid()) return;
  throw InvalidInput(
      what + " covers " + std::to_string(field.disparity.grid().count()) + " of " +
      std::to_string(lf.grid().count()) +
      " views, but labels are carried along the rays of all views; use one that covers them");
}

/// A field of the scene that lives as long as the scene's truth does.
std::shared_ptr<const DisparityField> true_field(const Scene& scene) {
  const LightField& lf = *scene.light_field;
  if (!scene.truth->has_disparity()) {
    throw InvalidInput(lf.info().name +
                       " has no true disparity; use the features image or image+estimate");
  }
  require_all_views(scene.truth->field, lf, "the true disparity of " + lf.info().name);
  return {scene.truth, &scene.truth->field};
}

}  // namespace

LabelingDisparity disparity_of(EstimatePtr estimate, const std::string& origin) {
  return {{estimate, &estimate->field}, origin, estimate};
}

std::shared_ptr<const ViewStack<float>> LabelingDisparity::confidence() const {
  if (!estimate || estimate->confidence.empty()) return nullptr;
  return {estimate, &estimate->confidence};
}

LabelingDisparity find_labeling_disparity(const Scene& scene, const LabelerParameters& parameters,
                                          const std::filesystem::path& result_file,
                                          const Progress& progress, Device device) {
  const LightField& lf = *scene.light_field;
  if (parameters.features == FeatureSet::ImageTruth) return {true_field(scene), "truth", nullptr};
  if (!result_file.empty()) {
    const std::string name = result_file.string();
    Estimate estimate = read_result_of(lf, result_file);
    check_fits(estimate, lf, name);
    require_all_views(estimate.field, lf, name);
    bring_to_focus(estimate, lf, progress);
    return disparity_of(std::make_shared<const Estimate>(std::move(estimate)), name);
  }
  return disparity_of(
      run_estimator(lf, {kLabelingEstimator, {}, {.device = device}}, progress).estimate,
      kLabelingEstimator);
}

bool has_edge_probabilities(const Scene& scene) {
  return scene.find_companion(CompanionKind::EdgeProbabilities) != nullptr;
}

std::shared_ptr<const ViewStack<float>> find_edge_probabilities(const Scene& scene,
                                                                const Progress& progress) {
  const Companion* file = scene.find_companion(CompanionKind::EdgeProbabilities);
  if (!file) return nullptr;
  return std::make_shared<const ViewStack<float>>(
      io::read_edge_probabilities(file->path, scene, progress));
}

}  // namespace episcope
