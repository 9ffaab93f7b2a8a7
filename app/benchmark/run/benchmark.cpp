// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/run/benchmark.h"

#include "app/benchmark/report/report_files.h"
#include "app/benchmark/report/scene_files.h"
#include "app/benchmark/run/run_log.h"
#include "app/benchmark/run/scene_fingerprint.h"
#include "app/benchmark/run/submission.h"
#include "app/benchmark/run/workload.h"
#include "app/session/judge/judge.h"
#include "app/session/run/run_estimator.h"
#include "app/session/scene/scene_range.h"
#include "engine/core/error.h"
#include "engine/evaluation/tables/parameter_search.h"
#include "engine/io/durable/make_folder.h"
#include "engine/io/maps/result_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <set>

namespace episcope {
namespace {

namespace fs = std::filesystem;

/// A scene while it is in memory.
struct OpenScene {
  Scene scene;
  std::string name;
  std::string input;
  std::string fingerprint;
  Interval range;
};

/// Judges as `options` say. What there is not to judge, or to judge against, is the scene's
/// problem.
EvaluationPtr judge_by(const EvaluationOptions& options, const Estimate& estimate,
                       const Scene& scene, BenchmarkResult& result) {
  try {
    auto evaluation = std::make_shared<const Evaluation>(judge(estimate, scene, options));
    result.notes.insert(result.notes.end(), evaluation->notes.begin(), evaluation->notes.end());
    return evaluation;
  } catch (const InvalidInput& error) {
    result.problem = error.what();
    return nullptr;
  }
}

/// Judges by both protocols; keeps the errors of the first for a picture.
EvaluationPtr judge_by_both(const Estimate& estimate, const Scene& scene, const Progress& progress,
                            BenchmarkResult& result) {
  EvaluationOptions options{.protocol = Protocol::Vmv2013, .progress = progress};
  const auto evaluation = judge_by(options, estimate, scene, result);
  if (!evaluation) return evaluation;
  result.vmv2013 = evaluation->metrics;
  const LightField& light_field = *scene.light_field;
  if (std::min(light_field.height(), light_field.width()) > 2 * kBenchmarkBorder) {
    options.protocol = Protocol::Benchmark2016;
    const auto inner = judge_by(options, estimate, scene, result);
    if (inner) result.benchmark2016 = inner->metrics;
  }
  return evaluation;
}

std::string shape_text(const LightField& light_field) {
  return fmt::format("{}×{} views of {}×{} px", light_field.grid().v, light_field.grid().u,
                     light_field.width(), light_field.height());
}

std::string unused_name(const std::string& wanted, const std::set<std::string>& taken) {
  std::string name = wanted;
  for (int copy = 2; taken.contains(name); ++copy) name = fmt::format("{}-{}", wanted, copy);
  return name;
}

/// Names of submissions beside those of methods.
std::vector<std::string> submission_names(const BenchmarkOptions& options) {
  std::set<std::string> taken;
  for (const Estimator& method : options.methods) taken.insert(method.info.id);
  std::vector<std::string> names;
  for (const fs::path& folder : options.submissions) {
    names.push_back(unused_name(submission_name(folder), taken));
    taken.insert(names.back());
  }
  return names;
}

class Runner {
 public:
  Runner(const BenchmarkOptions& options, const SceneLoader& load, const Progress& progress)
      : options_(options),
        load_(load),
        progress_(progress),
        log_(options.folder),
        workload_(progress),
        submission_names_(submission_names(options)) {
    for (const Estimator& method : options.methods) {
      grids_.push_back(options.has_search ? search_grid(method.parameters)
                                          : std::vector<ParameterSet>());
    }
    expect_work();
  }

  BenchmarkReport run() {
    for (const std::string& input : options_.inputs) {
      run_scene(input);
      write_report(options_.folder, report_);
    }
    return std::move(report_);
  }

 private:
  [[nodiscard]] BenchmarkRun table_run(const Estimator& method) const {
    const bool all = method.info.all_views && options_.views == ViewSelection::All;
    return plan_run(method, {}, all ? ViewSelection::All : ViewSelection::Center, false);
  }

  [[nodiscard]] std::size_t runs_per_scene() const {
    std::size_t count = options_.methods.size();
    for (const auto& grid : grids_) count += grid.size();
    return count;
  }

  /// Nothing for what an earlier call finished, else the mean of what is known of the method.
  [[nodiscard]] double expected_seconds(const std::string& input, const BenchmarkRun& run) const {
    double sum = 0;
    int count = 0;
    for (const BenchmarkRecord& record : log_.records()) {
      if (record.run.method != run.method || record.run.is_search != run.is_search) continue;
      const bool is_same = record.input == input && record.run.parameters == run.parameters;
      if (is_same && !record.result.has_failed) return 0;
      sum += record.result.seconds;
      ++count;
    }
    return count > 0 && sum > 0 ? sum / count : 1;
  }

  void expect_work() {
    for (const std::string& input : options_.inputs) {
      workload_.expect(1);
      for (const Estimator& method : options_.methods) {
        workload_.expect(expected_seconds(input, table_run(method)));
      }
      for (std::size_t i = 0; i < options_.methods.size(); ++i) {
        for (const ParameterSet& point : grids_[i]) {
          workload_.expect(expected_seconds(
              input, plan_run(options_.methods[i], point, ViewSelection::Center, true)));
        }
      }
    }
  }

  void run_scene(const std::string& input) {
    const std::optional<OpenScene> open = open_scene(input);
    if (!open) return workload_.skip(runs_per_scene());
    for (const Estimator& method : options_.methods) {
      const Progress part = workload_.next(open->name + ", " + method.info.id);
      report_.results.push_back(find_or_run(*open, method, table_run(method), part));
    }
    for (std::size_t i = 0; i < options_.submissions.size(); ++i) {
      progress_.check();
      judge_submission(*open, options_.submissions[i], submission_names_[i]);
    }
    if (!options_.has_search) return;
    if (!open->scene.truth->has_disparity())
      return workload_.skip(runs_per_scene() - options_.methods.size());
    for (std::size_t i = 0; i < options_.methods.size(); ++i) {
      search(*open, options_.methods[i], grids_[i]);
    }
  }

  std::optional<OpenScene> open_scene(const std::string& input) {
    const Progress part = workload_.next(input);
    OpenScene open{{}, {}, input, {}, {}};
    try {
      open.scene = load_(input, part);
    } catch (const Error& error) {
      report_.scenes.push_back({input, input, {}, {}, false, error.what()});
      return std::nullopt;
    }
    std::set<std::string> taken;
    for (const auto& scene : report_.scenes) taken.insert(scene.name);
    open.name = unused_name(open.scene.light_field->info().name, taken);
    open.fingerprint = scene_fingerprint(open.scene);
    open.range = known_disparity_range(open.scene);
    io::make_folder(options_.folder / "scenes" / open.name);
    const bool has_truth = write_scene_pictures(options_.folder, open.name, open.scene, open.range);
    report_.scenes.push_back(
        {open.name, input, shape_text(*open.scene.light_field), open.range, has_truth, {}});
    return open;
  }

  BenchmarkResult find_or_run(const OpenScene& open, const Estimator& method,
                              const BenchmarkRun& run, const Progress& part) {
    part.check();
    const std::string key = record_key(run, open.fingerprint);
    if (const BenchmarkRecord* record = log_.find(key, open.name)) {
      ++report_.reused;
      part.report(1);
      return record->result;
    }
    part.step("starting");
    BenchmarkRecord record{key, open.input, run, {}, {}};
    record.result.entry = run.method;
    record.result.scene = open.name;
    record.result.has_all_views = run.views == ViewSelection::All;
    run_and_judge(open, method, record, part);
    log_.add(record);
    return record.result;
  }

  void run_and_judge(const OpenScene& open, const Estimator& method, BenchmarkRecord& record,
                     const Progress& part) {
    BenchmarkResult& result = record.result;
    EstimatePtr estimate;
    try {
      estimate =
          run_estimator(*open.scene.light_field, method,
                        {record.run.method, record.run.parameters, {.views = record.run.views}},
                        part.part(0, 0.95))
              .estimate;
    } catch (const Error& error) {
      result.problem = error.what();
    } catch (const std::bad_alloc&) {
      result.problem = "not enough memory";
    }
    result.has_failed = !result.problem.empty();
    if (result.has_failed) return;
    result.seconds = estimate->seconds;
    result.notes = estimate->notes;
    part.step("evaluating");
    if (record.run.is_search) {
      const auto evaluation =
          judge_by({.protocol = Protocol::Vmv2013}, *estimate, open.scene, result);
      if (evaluation) result.vmv2013 = evaluation->metrics;
    } else {
      const auto center =
          std::make_shared<const Estimate>(center_of(*estimate, open.scene.light_field->center()));
      estimate = nullptr;
      record.files = judge_and_write(open, center, result);
      record.files.push_back(map_file(open.name, result.entry));
      io::write_result(options_.folder / record.files.back(), *center, part.part(0.95, 1));
    }
    part.check();
  }

  std::vector<std::string> judge_and_write(const OpenScene& open, const EstimatePtr& center,
                                           BenchmarkResult& result) {
    const auto evaluation = judge_by_both(*center, open.scene, progress_, result);
    return write_pictures(options_.folder, open.name, center, result.entry, evaluation, open.range);
  }

  void judge_submission(const OpenScene& open, const fs::path& folder, const std::string& name) {
    BenchmarkResult result;
    result.entry = name;
    result.scene = open.name;
    result.is_foreign = true;
    const LightField& light_field = *open.scene.light_field;
    std::optional<Estimate> estimate;
    try {
      estimate = read_submission(folder, light_field, light_field.info().name);
      if (!estimate) result.problem = "the submission has no map of this scene";
    } catch (const Error& error) {
      result.problem = error.what();
      result.has_failed = true;
    }
    if (estimate) {
      result.seconds = estimate->seconds;
      result.has_all_views = estimate->field.disparity.grid() == light_field.grid();
      result.notes = estimate->notes;
      const auto center =
          std::make_shared<const Estimate>(center_of(*estimate, light_field.center()));
      judge_and_write(open, center, result);
    }
    report_.results.push_back(std::move(result));
  }

  void search(const OpenScene& open, const Estimator& method,
              const std::vector<ParameterSet>& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Progress part = workload_.next(
          fmt::format("{}, {} {} of {}", open.name, method.info.id, i + 1, points.size()));
      const BenchmarkRun run = plan_run(method, points[i], ViewSelection::Center, true);
      const BenchmarkResult result = find_or_run(open, method, run, part);
      report_.searched.push_back({method.info.id, open.name, points[i],
                                  find_metric(result.vmv2013, "mse_100"), result.seconds,
                                  result.problem});
    }
  }

  const BenchmarkOptions& options_;
  const SceneLoader& load_;
  const Progress& progress_;
  RunLog log_;
  Workload workload_;
  std::vector<std::string> submission_names_;
  std::vector<std::vector<ParameterSet>> grids_;  ///< By method.
  BenchmarkReport report_;
};

}  // namespace

BenchmarkReport run_benchmark(const BenchmarkOptions& options, const SceneLoader& load,
                              const Progress& progress) {
  check_benchmark_folder(options.folder);
  for (const fs::path& folder : options.submissions) check_submission(folder);
  io::make_folder(options.folder);
  return Runner(options, load, progress).run();
}

void check_benchmark_folder(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::exists(folder, ignored)) return;
  if (!fs::is_directory(folder, ignored)) {
    throw IoError(folder, "is a file; name a folder for the benchmark");
  }
  if (fs::is_empty(folder, ignored) || fs::exists(folder / RunLog::kFileName, ignored)) return;
  throw IoError(folder, "contains something other than a benchmark; name an empty or a new folder");
}

}  // namespace episcope
