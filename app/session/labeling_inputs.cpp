// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/labeling_inputs.h"

#include "app/session/result_files.h"
#include "app/session/run_estimator.h"
#include "engine/core/error.h"
#include "engine/disparity/registry.h"
#include "engine/io/base/files.h"
#include "engine/io/formats/archive_companions.h"
#include "engine/labeling/pixel_features.h"

#include <set>
#include <utility>

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

EstimatePtr estimate_for_labels(const Scene& scene, Device device, const Progress& progress) {
  return run_estimator(scene, find_estimator(kLabelingEstimator), {{"corners", false}},
                       {.device = device}, progress)
      .estimate;
}

LabelingDisparity find_labeling_disparity(const Scene& scene, const LabelerParameters& parameters,
                                          const std::filesystem::path& result_file,
                                          const Progress& progress, Device device) {
  const LightField& lf = *scene.light_field;
  if (parameters.features == FeatureSet::ImageTruth) return {true_field(scene), "truth", nullptr};
  if (!result_file.empty()) {
    const std::string name = result_file.string();
    Estimate estimate = read_result_of(lf, result_file);
    require_all_views(estimate.field, lf, name);
    bring_to_focus(estimate, lf, progress);
    return disparity_of(std::make_shared<const Estimate>(std::move(estimate)), name);
  }
  return disparity_of(estimate_for_labels(scene, device, progress), kLabelingEstimator);
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

Labeler labeler_of(const Scene& scene, const LabelingDisparity& disparity, const Progress& progress,
                   Device device) {
  Labeler labeler(scene.light_field, disparity.field, find_edge_probabilities(scene, progress),
                  disparity.confidence());
  labeler.compute_on(device);
  return labeler;
}

LabelingScores judge_labeling(const Labeling& labeling, const Scene& scene,
                              const LabelingDisparity& disparity, const Progress& progress) {
  return judge_labeling(labeling.labels, scene.light_field->center(), scene.truth->labels,
                        *scene.truth, disparity.field.get(), progress);
}

namespace {

std::vector<std::int32_t> ids_of(const Scribbles& painted, int label_count) {
  std::set<std::int32_t> found;
  for (const ViewScribbles& view : painted.views) {
    for (const std::int32_t label : view.labels) {
      if (label > 0) found.insert(label);
    }
  }
  if (static_cast<int>(found.size()) == label_count) return {found.begin(), found.end()};
  std::vector<std::int32_t> ids;
  for (int id = 1; id <= label_count; ++id) ids.push_back(id);
  return ids;
}

void write_features(const std::filesystem::path& path, const Scene& scene, const Scribbles& painted,
                    const LabelerParameters& parameters, const LabelingDisparity& disparity,
                    const Progress& progress) {
  Labeler labeler(scene.light_field, disparity.field, nullptr, disparity.confidence());
  const Labeling labeling = labeler.label(painted, parameters, {{0, 0}, scene.light_field->grid()},
                                          progress.part(0, 0.8));
  const LabelProbabilities& p = labeling.probabilities;
  io::write_label_probabilities(
      path, static_cast<int>(p.ids.size()), [&p](ViewIndex view) { return p.view(view).view(); },
      scene, progress.part(0.8, 1));
}

bool has_full_truth(const Scene& scene) {
  return scene.truth->has_disparity() &&
         scene.truth->field.disparity.grid() == scene.light_field->grid();
}

}  // namespace

LabelProbabilities read_all_probabilities(const std::filesystem::path& path, const Scene& scene,
                                          const Scribbles& painted, const Progress& progress) {
  const io::ProbabilityFile file(path, scene);
  LabelProbabilities probabilities;
  probabilities.grid = scene.light_field->grid();
  probabilities.ids = ids_of(painted, file.label_count());
  for (int i = 0; i < probabilities.grid.count(); ++i) {
    progress.check();
    const ViewIndex view = probabilities.view_at(i);
    if (!file.contains(view)) {
      throw InvalidInput(path.string() +
                         " has probabilities of the center view alone; use a file " +
                         "with those of all views");
    }
    probabilities.views.push_back(io::bytes_of(file.view(view)));
    progress.report((i + 1.0) / probabilities.grid.count());
  }
  return probabilities;
}

std::vector<std::string> write_label_archive(const std::filesystem::path& folder,
                                             const Scene& scene, const Scribbles& painted,
                                             const LabelerParameters& parameters,
                                             const LabelingDisparity& estimate,
                                             const Progress& progress) {
  io::make_folder(folder);
  std::vector<std::string> written;
  const auto path_of = [&](CompanionKind kind) {
    return folder / written.emplace_back(io::companion_file(kind));
  };
  const ViewRectangle all{{0, 0}, scene.light_field->grid()};
  progress.step("writing edges");
  io::write_edge_probabilities(
      path_of(CompanionKind::EdgeProbabilities),
      edge_probabilities(*scene.light_field, all, *estimate.field, {}, progress.part(0, 0.05),
                         estimate.confidence().get()),
      scene, progress.part(0.05, 0.1));
  std::vector<std::pair<FeatureSet, CompanionKind>> sets = {
      {FeatureSet::Image, CompanionKind::ImageProbabilities},
      {FeatureSet::ImageEstimate, CompanionKind::DepthProbabilities}};
  if (has_full_truth(scene)) {
    sets.emplace_back(FeatureSet::ImageTruth, CompanionKind::TrueDepthProbabilities);
  }
  LabelerParameters each = parameters;
  each.regularizer = Regularizer::None;
  double begin = 0.1;
  for (const auto& [features, kind] : sets) {
    const double end = begin + 0.9 / static_cast<double>(sets.size());
    each.features = features;
    const Progress part = progress.part(begin, end);
    const LabelingDisparity disparity = features == FeatureSet::ImageTruth
                                            ? find_labeling_disparity(scene, each, {}, part)
                                            : estimate;
    write_features(path_of(kind), scene, painted, each, disparity, part);
    begin = end;
  }
  return written;
}

}  // namespace episcope
