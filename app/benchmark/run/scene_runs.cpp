// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/run/scene_runs.h"

#include "app/benchmark/report/scene_files.h"
#include "app/session/judge/verdict.h"
#include "app/session/run/run_estimator.h"
#include "engine/core/error.h"
#include "engine/io/maps/result_file.h"

#include <new>

namespace episcope {
namespace {

void take(Verdict verdict, BenchmarkResult& result) {
  result.vmv2013 = std::move(verdict.vmv2013);
  result.benchmark2016 = std::move(verdict.benchmark2016);
  result.notes.insert(result.notes.end(), verdict.notes.begin(), verdict.notes.end());
  result.problem = std::move(verdict.problem);
}

void fail(BenchmarkResult& result, const std::string& problem) {
  result.problem = problem;
  result.has_failed = true;
}

}  // namespace

SceneRuns::SceneRuns(const BenchmarkOptions& options, const OpenScene& open)
    : options_(options), open_(open), labels_(open.scene, open.name) {}

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
      labels_.run(options_.labels[planned.index], options_.folder, progress, record);
    } else {
      run_and_judge(options_.methods[planned.index], progress, record);
    }
  } catch (const Error& error) {
    fail(record.result, error.what());
  } catch (const std::bad_alloc&) {
    fail(record.result, "not enough memory");
  }
  progress.check();
  return record;
}

std::vector<std::string> SceneRuns::judge_and_write(const EstimatePtr& center,
                                                    BenchmarkResult& result,
                                                    const Progress& progress) const {
  Verdict verdict = judge_by_both(*center, open_.scene, progress);
  const EvaluationPtr evaluation = verdict.evaluation;
  take(std::move(verdict), result);
  return write_pictures(options_.folder, open_.name, center, result.entry, evaluation, open_.range);
}

void SceneRuns::run_and_judge(const Estimator& method, const Progress& progress,
                              BenchmarkRecord& record) {
  BenchmarkResult& result = record.result;
  EstimatePtr estimate = run_estimator(*open_.scene.light_field, method,
                                       {record.run.method,
                                        record.run.parameters,
                                        {.views = record.run.views, .device = record.run.device}},
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

}  // namespace episcope
