// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/run/benchmark.h"

#include "app/benchmark/report/report_files.h"
#include "app/benchmark/report/scene_files.h"
#include "app/benchmark/run/label_runs.h"
#include "app/benchmark/run/run_log.h"
#include "app/benchmark/run/scene_fingerprint.h"
#include "app/benchmark/run/submission.h"
#include "app/benchmark/run/workload.h"
#include "app/session/judge/verdict.h"
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

void take(Verdict verdict, BenchmarkResult& result) {
  result.vmv2013 = std::move(verdict.vmv2013);
  result.benchmark2016 = std::move(verdict.benchmark2016);
  result.notes.insert(result.notes.end(), verdict.notes.begin(), verdict.notes.end());
  result.problem = std::move(verdict.problem);
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
    report_.has_disparities =
        options.labels.empty() || !options.methods.empty() || !options.submissions.empty();
    report_.has_labels = !options.labels.empty();
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
    return plan_run(method, {}, all ? ViewSelection::All : ViewSelection::Center, RunKind::Table);
  }

  [[nodiscard]] std::size_t runs_per_scene() const {
    std::size_t count = options_.methods.size() + options_.labels.size();
    for (const auto& grid : grids_) count += grid.size();
    return count;
  }

  /// Nothing for what an earlier call finished, else the mean of what is known of the method.
  [[nodiscard]] double expected_seconds(const std::string& input, const BenchmarkRun& run) const {
    double sum = 0;
    int count = 0;
    for (const BenchmarkRecord& record : log_.records()) {
      if (record.run.method != run.method || record.run.kind != run.kind) continue;
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
      for (const LabelerParameters& way : options_.labels) {
        workload_.expect(expected_seconds(input, plan_label_run(way)));
      }
      for (std::size_t i = 0; i < options_.methods.size(); ++i) {
        for (const ParameterSet& point : grids_[i]) {
          workload_.expect(expected_seconds(
              input, plan_run(options_.methods[i], point, ViewSelection::Center, RunKind::Search)));
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
    label(*open);
    for (std::size_t i = 0; i < options_.submissions.size(); ++i) {
      progress_.check();
      judge_submission(*open, options_.submissions[i], submission_names_[i]);
    }
    if (!options_.has_search) return;
    if (!open->scene.truth->has_disparity())
      return workload_.skip(runs_per_scene() - options_.methods.size() - options_.labels.size());
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
    if (!options_.labels.empty()) {
      report_.scenes.back().has_label_picture =
          write_label_truth(options_.folder, open.name, open.scene);
    }
    return open;
  }

  BenchmarkResult find_or_run(const OpenScene& open, const Estimator& method,
                              const BenchmarkRun& run, const Progress& part) {
    return find_or_run(open, open.fingerprint, run, part,
                       [&](BenchmarkRecord& record) { run_and_judge(open, method, record, part); });
  }

  /// `work` fills the record; what it throws is the result's problem.
  template <class Work>
  BenchmarkResult find_or_run(const OpenScene& open, const std::string& fingerprint,
                              const BenchmarkRun& run, const Progress& part, const Work& work) {
    part.check();
    const std::string key = record_key(run, fingerprint);
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
    try {
      work(record);
    } catch (const Error& error) {
      fail(record.result, error.what());
    } catch (const std::bad_alloc&) {
      fail(record.result, "not enough memory");
    }
    part.check();
    log_.add(record);
    return record.result;
  }

  static void fail(BenchmarkResult& result, const std::string& problem) {
    result.problem = problem;
    result.has_failed = true;
  }

  void run_and_judge(const OpenScene& open, const Estimator& method, BenchmarkRecord& record,
                     const Progress& part) {
    BenchmarkResult& result = record.result;
    EstimatePtr estimate =
        run_estimator(*open.scene.light_field, method,
                      {record.run.method, record.run.parameters, {.views = record.run.views}},
                      part.part(0, 0.95))
            .estimate;
    result.seconds = estimate->seconds;
    result.notes = estimate->notes;
    part.step("evaluating");
    if (record.run.kind == RunKind::Search) {
      take(judge_by_errors(*estimate, open.scene, part), result);
    } else {
      const auto center =
          std::make_shared<const Estimate>(center_of(*estimate, open.scene.light_field->center()));
      estimate = nullptr;
      record.files = judge_and_write(open, center, result);
      record.files.push_back(map_file(open.name, result.entry));
      io::write_result(options_.folder / record.files.back(), *center, part.part(0.95, 1));
    }
  }

  void label(const OpenScene& open) {
    if (options_.labels.empty()) return;
    const std::string fingerprint = open.fingerprint + label_fingerprint(open.scene);
    LabelRuns labels(open.scene, open.name);
    for (const LabelerParameters& way : options_.labels) {
      const Progress part = workload_.next(open.name + ", " + label_entry(way));
      report_.results.push_back(find_or_run(
          open, fingerprint, plan_label_run(way), part,
          [&](BenchmarkRecord& record) { labels.run(way, options_.folder, part, record); }));
    }
  }

  std::vector<std::string> judge_and_write(const OpenScene& open, const EstimatePtr& center,
                                           BenchmarkResult& result) {
    Verdict verdict = judge_by_both(*center, open.scene, progress_);
    const EvaluationPtr evaluation = verdict.evaluation;
    take(std::move(verdict), result);
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
      const BenchmarkRun run = plan_run(method, points[i], ViewSelection::Center, RunKind::Search);
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
