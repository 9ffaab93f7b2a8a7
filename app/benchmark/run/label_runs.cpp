// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/run/label_runs.h"

#include "app/benchmark/report/scene_files.h"
#include "app/benchmark/run/scene_fingerprint.h"
#include "app/session/labels/judge_labeling.h"
#include "engine/core/error.h"
#include "engine/evaluation/tables/label_tables.h"
#include "engine/io/maps/parameter_json.h"

#include <utility>

namespace episcope {
namespace {

// Raised when the same parameters give other labels.
constexpr int kRevision = 1;

void require_strokes(const Scene& scene, const std::string& name) {
  if (!scene.scribbles.empty()) return;
  throw InvalidInput(name + " has no strokes beside it; paint some in the window and save them");
}

}  // namespace

std::string label_entry(const LabelerParameters& parameters) {
  return name_of(parameters.features) + "-" + name_of(parameters.regularizer);
}

BenchmarkRun plan_label_run(const LabelerParameters& parameters) {
  return {RunKind::Labels, label_entry(parameters), kRevision, labeler_schema().values(parameters),
          ViewSelection::All};
}

std::string label_fingerprint(const Scene& scene) {
  Fingerprint fingerprint;
  for (const ViewScribbles& painted : scene.scribbles.views) {
    fingerprint.add(view_text(painted.view));
    fingerprint.add_image(painted.labels.view());
  }
  for (int i = 0; i < scene.truth->labels.grid().count(); ++i) {
    fingerprint.add_image(scene.truth->labels.view(scene.truth->labels.view_at(i)));
  }
  const DisparityField& field = scene.truth->field;
  for (int i = 0; i < field.disparity.grid().count(); ++i) {
    fingerprint.add_image(field.disparity.view(field.disparity.view_at(i)));
  }
  return fingerprint.text();
}

LabelRuns::LabelRuns(const Scene& scene, std::string name)
    : scene_(scene), name_(std::move(name)) {}

const LabelingDisparity& LabelRuns::disparity_for(const LabelerParameters& parameters,
                                                  const Progress& progress) {
  auto& disparity = parameters.features == FeatureSet::ImageTruth ? truth_ : estimate_;
  if (!disparity) disparity = find_labeling_disparity(scene_, parameters, {}, progress);
  return *disparity;
}

void LabelRuns::run(const LabelerParameters& parameters, const std::filesystem::path& folder,
                    const Progress& progress, BenchmarkRecord& record) {
  require_strokes(scene_, name_);
  const LabelingDisparity& disparity = disparity_for(parameters, progress.part(0, 0.2));
  const LightField& light_field = *scene_.light_field;
  Labeler labeler(scene_.light_field, disparity.field, find_edge_probabilities(scene_, progress),
                  disparity.confidence());
  const auto labeling = std::make_shared<const Labeling>(labeler.label(
      scene_.scribbles, parameters, {{0, 0}, light_field.grid()}, progress.part(0.2, 0.95)));
  progress.step("evaluating");
  const LabelingScores scores =
      judge_labeling(labeling->labels, light_field.center(), scene_.truth->labels, *scene_.truth,
                     disparity.field.get(), progress.part(0.95, 1));
  BenchmarkResult& result = record.result;
  result.seconds = labeling->seconds;
  result.labels = label_metrics(scores.all_views, scores.view, scores.consistency);
  if (!scores.all_views.all.share()) result.problem = name_ + " has no true labels of all views";
  record.files = write_label_pictures(folder, name_, scene_, labeling, result.entry);
}

}  // namespace episcope
