// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/scene_runs.h"

#include "app/session/label_review.h"
#include "app/session/picture.h"
#include "app/session/result_files.h"
#include "app/session/run_estimator.h"
#include "app/session/scene_summary.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/evaluation/benchmark_tables.h"
#include "engine/evaluation/parameter_search.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/result_file.h"
#include "engine/render/shade.h"

#include <algorithm>
#include <new>
#include <utility>

namespace episcope {
namespace {

void take(ResultScores scores, BenchmarkResult& result) {
  result.vmv2013 = std::move(scores.vmv2013);
  result.benchmark2016 = std::move(scores.benchmark2016);
  result.notes.insert(result.notes.end(), scores.notes.begin(), scores.notes.end());
  result.problem = std::move(scores.problem);
}

void fail(BenchmarkResult& result, const std::string& problem) {
  result.problem = problem;
  result.has_failed = true;
}

}  // namespace

SceneRuns::SceneRuns(const BenchmarkOptions& options, const LoadedScene& open)
    : options_(options), open_(open) {}

std::string SceneRuns::key(const BenchmarkRun& run) const {
  return record_key(run,
                    run.kind == RunKind::Labels ? open_.labels_fingerprint : open_.fingerprint);
}

BenchmarkRecord SceneRuns::make(const PlannedRun& planned, const Progress& progress) {
  progress.step("starting");
  BenchmarkRecord record{key(planned.run), open_.input, planned.run, {}, {}};
  record.result.entry = planned.run.method;
  record.result.scene = open_.name;
  record.result.has_all_views = planned.run.views == ViewSelection::All;
  try {
    if (planned.run.kind == RunKind::Labels) {
      label_and_judge(options_.labels[planned.index], progress, record);
    } else {
      run_and_judge(options_.methods[planned.index], progress, record);
    }
  } catch (const Error& error) {
    fail(record.result, error.what());
  } catch (const std::bad_alloc&) {
    fail(record.result, kNotEnoughMemory);
  }
  progress.check();
  return record;
}

std::vector<std::string> SceneRuns::judge_and_write(const EstimatePtr& center,
                                                    BenchmarkResult& result,
                                                    const Progress& progress) const {
  ResultScores scores = judge_by_both(*center, open_.scene, progress);
  const EvaluationPtr evaluation = scores.evaluation;
  take(std::move(scores), result);
  return write_pictures(options_.folder, open_.name, center, result.entry, evaluation, open_.range);
}

void SceneRuns::run_and_judge(const Estimator& method, const Progress& progress,
                              BenchmarkRecord& record) {
  BenchmarkResult& result = record.result;
  EstimatePtr estimate = run_estimator(open_.scene, method, record.run.parameters,
                                       {.views = record.run.views, .device = record.run.device},
                                       progress.part(0, 0.95))
                             .estimate;
  result.seconds = estimate->seconds;
  result.notes = estimate->notes;
  progress.step("evaluating");
  if (record.run.kind == RunKind::Search) {
    take(judge_by_errors(*estimate, open_.scene, progress), result);
    return;
  }
  const auto center =
      std::make_shared<const Estimate>(center_of(*estimate, open_.scene.light_field->center()));
  estimate = nullptr;
  record.files = judge_and_write(center, result, progress.part(0.95, 0.95));
  record.files.push_back(map_file(open_.name, result.entry));
  io::write_result(options_.folder / record.files.back(), *center, progress.part(0.95, 1));
}

namespace {

// Raised when the same parameters give other labels.
constexpr int kLabelRevision = 1;

/// Labels of all views with these parameters, named "image+estimate-rayspace".
BenchmarkRun label_run(const LabelerParameters& way) {
  return {RunKind::Labels, name_of(way.features) + "-" + name_of(way.regularizer), kLabelRevision,
          labeler_schema().values(way), ViewSelection::All};
}

/// Changes with what labels and their scores depend on besides `scene_fingerprint`: the strokes,
/// and true labels and disparity of all views.
std::string label_fingerprint(const Scene& scene) {
  Fingerprint fingerprint;
  for (const ViewScribbles& painted : scene.scribbles.views) {
    fingerprint.add(view_text(painted.view));
    fingerprint.add_image(painted.labels.view());
  }
  const auto add_views = [&fingerprint](const auto& stack) {
    for (int i = 0; i < stack.grid().count(); ++i) {
      fingerprint.add_image(stack.view(stack.view_at(i)));
    }
  };
  add_views(scene.truth->labels);
  add_views(scene.truth->field.disparity);
  return fingerprint.text();
}

}  // namespace

std::string LoadedScene::whole_fingerprint() const {
  return labels_fingerprint.empty() ? fingerprint : text_fingerprint(labels_fingerprint);
}

LoadedScene open_benchmark_scene(const BenchmarkOptions& options, const std::string& input,
                                 const SceneLoader& load, const std::set<std::string>& taken,
                                 const Progress& progress) {
  LoadedScene open{load(input, progress), {}, input, {}, {}, {}};
  open.name = unused_name(open.scene.light_field->info().name, taken);
  open.fingerprint = scene_fingerprint(open.scene);
  if (!options.labels.empty()) {
    open.labels_fingerprint = open.fingerprint + label_fingerprint(open.scene);
  }
  open.range = known_disparity_range(open.scene);
  return open;
}

void require_unchanged(const LoadedScene& open, const std::string& whole_fingerprint) {
  if (open.whole_fingerprint() == whole_fingerprint) return;
  throw InvalidInput(open.input +
                     ": the scene has changed since the plan was made; make the plan again with "
                     "--plan or --slurm, which keeps what is still valid");
}

std::string unused_name(const std::string& wanted, const std::set<std::string>& taken) {
  return unique_name(wanted, "-", [&](const std::string& name) { return taken.contains(name); });
}

namespace {

BenchmarkRun table_run(const Estimator& method, const BenchmarkOptions& options) {
  const bool all = method.info.all_views && options.views == ViewSelection::All;
  const ViewSelection views = all ? ViewSelection::All : ViewSelection::Center;
  return plan_run(method, {}, {.views = views, .device = options.device}, RunKind::Table);
}

}  // namespace

std::vector<PlannedRun> planned_runs(const BenchmarkOptions& options) {
  std::vector<PlannedRun> runs;
  const std::vector<Estimator>& methods = options.methods;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    runs.push_back({table_run(methods[i], options), i});
  }
  for (std::size_t i = 0; i < options.labels.size(); ++i) {
    runs.push_back({label_run(options.labels[i]), i});
  }
  for (std::size_t i = 0; options.has_search && i < methods.size(); ++i) {
    for (ParameterSet& point : search_grid(methods[i].parameters)) {
      runs.push_back(
          {plan_run(methods[i], point, {.views = ViewSelection::Center, .device = options.device},
                    RunKind::Search),
           i, std::move(point)});
    }
  }
  return runs;
}

namespace {

using render::Quantity;

std::string in_scene(const std::string& scene, const std::string& file) {
  return "scenes/" + scene + "/" + file;
}

void write_map(const std::filesystem::path& path, const MapSource& source, Interval range) {
  io::write_picture(path,
                    map_picture(*make_map(source), shading_of(source.quantity, range)).view());
}

// Labels of the center view of a scene.
MapSource labels_source(const Scene& scene, Quantity quantity) {
  MapSource source;
  source.quantity = quantity;
  source.view = scene.light_field->center();
  source.light_field = scene.light_field;
  source.label_infos = scene.scribbles.labels;
  source.true_labels = true_labels_of(scene.truth);
  return source;
}

}  // namespace

std::string scene_file(const std::string& scene, const std::string& what) {
  return in_scene(scene, what + ".png");
}

std::string picture_file(const std::string& scene, const std::string& entry,
                         const std::string& what) {
  return in_scene(scene, entry + "-" + what + ".png");
}

std::string map_file(const std::string& scene, const std::string& entry) {
  return in_scene(scene, entry + ".h5");
}

bool write_scene_pictures(const std::filesystem::path& folder, const std::string& name,
                          const Scene& scene, Interval range) {
  const ViewIndex center = scene.light_field->center();
  io::write_picture(folder / scene_file(name, "view"),
                    render::shade_view(*scene.light_field, center).view());
  const MapSource truth{.quantity = Quantity::Truth,
                        .view = center,
                        .light_field = scene.light_field,
                        .truth = scene.truth};
  if (!reason_against(truth).empty()) return false;
  write_map(folder / scene_file(name, "truth"), truth, shown_range(range, {}));
  return true;
}

std::vector<std::string> write_pictures(const std::filesystem::path& folder,
                                        const std::string& scene, const EstimatePtr& center,
                                        const std::string& entry, const EvaluationPtr& evaluation,
                                        Interval range) {
  MapSource source{.quantity = Quantity::Disparity,
                   .view = center->field.disparity.first(),
                   .estimate = center,
                   .evaluation = evaluation};
  std::vector<std::string> files{picture_file(scene, entry, "disparity")};
  write_map(folder / files.front(), source, shown_range(range, display_range(*center)));
  if (!evaluation) return files;
  source.quantity = Quantity::SignedError;
  files.push_back(picture_file(scene, entry, "error"));
  write_map(folder / files.back(), source, range);
  return files;
}

bool write_label_truth(const std::filesystem::path& folder, const std::string& name,
                       const Scene& scene) {
  MapSource source = labels_source(scene, Quantity::TrueLabels);
  source.truth = scene.truth;
  if (!reason_against(source).empty()) return false;
  write_map(folder / scene_file(name, "labels"), source, {});
  return true;
}

Estimate center_of(const Estimate& estimate, ViewIndex center) {
  Estimate one = one_view(estimate, center);
  if (estimate.field.disparity.grid().count() > 1) {
    one.notes.emplace_back("the seconds are those of all views");
  }
  return one;
}

namespace {

/// Pictures of the labels of the center view and, where true labels are known, of what is wrong.
/// Returns what was written.
std::vector<std::string> write_label_pictures(const std::filesystem::path& folder,
                                              const std::string& name, const Scene& scene,
                                              const LabelingPtr& labeling,
                                              const std::string& entry) {
  MapSource source = labels_source(scene, Quantity::Segmentation);
  source.labeling = labeling;
  std::vector<std::string> files{picture_file(name, entry, "labels")};
  write_map(folder / files.front(), source, {});
  source.quantity = Quantity::WrongLabels;
  if (!reason_against(source).empty()) return files;
  files.push_back(picture_file(name, entry, "wrong"));
  write_map(folder / files.back(), source, {});
  return files;
}

}  // namespace

const LabelingDisparity& SceneRuns::disparity_for(const LabelerParameters& way,
                                                  const Progress& progress) {
  const bool is_true = way.features == FeatureSet::ImageTruth;
  const auto found = disparities_.find(is_true);
  if (found != disparities_.end()) return found->second;
  return disparities_[is_true] = find_labeling_disparity(open_.scene, way, {}, progress);
}

void SceneRuns::label_and_judge(const LabelerParameters& way, const Progress& progress,
                                BenchmarkRecord& record) {
  const Scene& scene = open_.scene;
  if (scene.scribbles.empty()) {
    throw InvalidInput(open_.name +
                       " has no strokes beside it; paint some in the window and save them");
  }
  const LabelingDisparity& disparity = disparity_for(way, progress.part(0, 0.2));
  const GridShape grid = scene.light_field->grid();
  Labeler labeler = labeler_of(scene, disparity, progress);
  const auto labeling = std::make_shared<const Labeling>(
      labeler.label(scene.scribbles, way, {{0, 0}, grid}, progress.part(0.2, 0.95)));
  progress.step("evaluating");
  const LabelingScores scores = judge_labeling(*labeling, scene, disparity, progress.part(0.95, 1));
  BenchmarkResult& result = record.result;
  result.seconds = labeling->seconds;
  result.labels = label_metrics(scores.all_views, scores.view, scores.consistency);
  if (!scores.all_views.all.share()) {
    result.problem = open_.name + " has no true labels of all views";
  }
  record.files = write_label_pictures(options_.folder, open_.name, scene, labeling, result.entry);
}

}  // namespace episcope
