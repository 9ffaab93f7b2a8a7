// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/labels/label_archive.h"

#include "engine/core/error.h"
#include "engine/io/archive/companions.h"
#include "engine/io/durable/make_folder.h"
#include "engine/labeling/labeler.h"
#include "engine/labeling/rays/edge_probability.h"

#include <set>
#include <utility>

namespace episcope {
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
                         " has probabilities of the centre view alone; use a file " +
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
