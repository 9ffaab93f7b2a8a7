// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/benchmark.h"

#include "app/benchmark/run_log.h"
#include "app/benchmark/scene_runs.h"
#include "app/session/result_files.h"
#include "app/session/result_fit.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/core/text_table.h"
#include "engine/io/base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

namespace episcope {
namespace {

namespace fs = std::filesystem;

// Results of another program in a folder: a map for each scene, anywhere below it, named after the
// scene (`cotton.pfm`, `disp_maps/cotton.h5`) or alone in a folder of that name
// (`cotton/result.tif`); upper and lower case do not matter. Maps are of any form
// that `read_result_of` reads. Seconds come from a result file, else from a text file named
// after the scene (`runtimes/cotton.txt`, `cotton.txt`) whose first word is a number.

bool is_map(const fs::path& path) {
  const auto form = map_form_of(path);
  return form && *form != MapForm::PointCloud;
}

/// Files below the folder that `accepts` takes, sorted.
template <class Accepts>
std::vector<fs::path> files_below(const fs::path& folder, Accepts accepts) {
  std::vector<fs::path> files;
  constexpr auto options = fs::directory_options::skip_permission_denied;
  for (const auto& entry : fs::recursive_directory_iterator(folder, options)) {
    if (entry.is_regular_file() && accepts(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> maps_of(const fs::path& folder, const std::string& scene) {
  const std::string name = lower_case(scene);
  auto maps = files_below(folder, [&](const fs::path& path) {
    return is_map(path) && lower_case(path.stem().string()) == name;
  });
  if (!maps.empty()) return maps;
  return files_below(folder, [&](const fs::path& path) {
    return is_map(path) && lower_case(path.parent_path().filename().string()) == name;
  });
}

double seconds_of(const fs::path& folder, const std::string& scene) {
  const auto texts = files_below(folder, [&](const fs::path& path) {
    return lower_case(path.extension().string()) == ".txt" &&
           lower_case(path.stem().string()) == lower_case(scene);
  });
  if (texts.empty()) return 0;
  std::ifstream in(texts.front());
  std::string word;
  in >> word;
  const double seconds = io::parse_number(word).value_or(0);
  return std::isfinite(seconds) ? std::max(0.0, seconds) : 0;
}

std::string submission_name(const fs::path& folder) {
  return (fs::absolute(folder) / "x").lexically_normal().parent_path().filename().string();
}

/// Throws IoError unless `folder` is a folder.
void check_submission(const fs::path& folder) {
  if (io::is_folder(folder)) return;
  throw IoError(folder, "is not a folder; a submission is a folder of maps named after the scenes");
}

/// The map for the light field of a scene, empty if the submission has none. Its notes tell how it
/// fits (fit_of). Throws IoError, InvalidInput if it cannot be read, if there are several, or if
/// size or views do not fit.
std::optional<Estimate> read_submission(const fs::path& folder, const Scene& scene,
                                        const io::MapReading& reading) {
  const LightField& light_field = *scene.light_field;
  const std::string& name = light_field.info().name;
  const std::vector<fs::path> maps = maps_of(folder, name);
  if (maps.empty()) return std::nullopt;
  if (maps.size() > 1) {
    throw IoError(folder, "contains several maps of " + name + ", " + maps[0].filename().string() +
                              " and " + maps[1].filename().string() + "; keep one");
  }
  Estimate estimate = read_result_of(light_field, maps.front(), reading);
  bring_to_focus(estimate, light_field, Progress());
  const ResultFit fit = fit_of(estimate, scene);
  if (estimate.version.empty()) estimate.notes.clear();  // the fit tells them
  for (const std::string& sentence : fit.sentences()) {
    estimate.notes.push_back(maps.front().filename().string() + ": " + sentence);
  }
  if (!estimate.field.contains(light_field.center())) {
    throw IoError(maps.front(), "does not cover the center view, which is evaluated");
  }
  if (!(estimate.seconds > 0)) estimate.seconds = seconds_of(folder, name);
  return estimate;
}

std::string shape_text(const LightField& light_field) {
  return fmt::format("{}×{} views of {}×{} px", light_field.grid().v, light_field.grid().u,
                     light_field.width(), light_field.height());
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

BenchmarkResult unknown_result(const BenchmarkRun& run, const std::string& scene) {
  BenchmarkResult result;
  result.entry = run.method;
  result.scene = scene;
  result.has_all_views = run.views == ViewSelection::All;
  result.problem = "not computed yet";
  result.has_failed = true;
  return result;
}

class Runner {
 public:
  Runner(const BenchmarkOptions& options, const SceneLoader& load, const Progress& progress)
      : options_(options),
        load_(load),
        progress_(progress),
        log_(options.folder),
        workload_(progress),
        submission_names_(submission_names(options)),
        runs_(planned_runs(options)) {
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
  /// Nothing for what an earlier call finished, else the mean of what is known of the method.
  [[nodiscard]] double expected_seconds(const std::string& input, const BenchmarkRun& run) const {
    double sum = 0;
    int count = 0;
    for (const BenchmarkRecord& record : log_.all()) {
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
      for (const PlannedRun& planned : runs_) {
        workload_.expect(options_.recorded ? 0 : expected_seconds(input, planned.run));
      }
    }
  }

  void run_scene(const std::string& input) {
    const std::optional<LoadedScene> open = open_scene(input);
    if (!open) return workload_.skip(runs_.size());
    SceneRuns scene_runs(options_, *open);
    const auto is_search = [](const PlannedRun& each) { return each.run.kind == RunKind::Search; };
    const auto first_search = std::ranges::find_if(runs_, is_search);
    for (auto planned = runs_.begin(); planned != first_search; ++planned) {
      const Progress part = workload_.next(open->name + ", " + planned->run.method);
      report_.results.push_back(find_or_run(*open, scene_runs, *planned, part));
    }
    for (std::size_t i = 0; i < options_.submissions.size(); ++i) {
      progress_.check();
      judge_submission(*open, scene_runs, i);
    }
    if (!open->scene.truth->has_disparity()) {
      return workload_.skip(static_cast<std::size_t>(runs_.end() - first_search));
    }
    for (auto planned = first_search; planned != runs_.end(); ++planned) {
      search(*open, scene_runs, *planned);
    }
  }

  std::optional<LoadedScene> open_scene(const std::string& input) {
    const Progress part = workload_.next(input);
    std::set<std::string> taken;
    for (const auto& scene : report_.scenes) taken.insert(scene.name);
    std::optional<LoadedScene> open;
    try {
      open = open_benchmark_scene(options_, input, load_, taken, part);
    } catch (const Error& error) {
      report_.scenes.push_back({input, input, {}, {}, false, error.what()});
      return std::nullopt;
    }
    if (options_.recorded) {
      require_unchanged(*open, options_.recorded->at(report_.scenes.size()));
    }
    io::make_folder(options_.folder / "scenes" / open->name);
    const bool has_truth =
        write_scene_pictures(options_.folder, open->name, open->scene, open->range);
    report_.scenes.push_back(
        {open->name, input, shape_text(*open->scene.light_field), open->range, has_truth, {}});
    if (!options_.labels.empty()) {
      report_.scenes.back().has_label_picture =
          write_label_truth(options_.folder, open->name, open->scene);
    }
    return open;
  }

  BenchmarkResult find_or_run(const LoadedScene& open, SceneRuns& scene_runs,
                              const PlannedRun& planned, const Progress& part) {
    part.check();
    const std::string key = scene_runs.key(planned.run);
    if (const BenchmarkRecord* record = log_.find(key, open.name)) {
      ++report_.reused;
      part.report(1);
      return record->result;
    }
    if (options_.recorded) {
      const BenchmarkRecord* failed = log_.last(key, open.name);
      return failed && failed->result.has_failed ? failed->result
                                                 : unknown_result(planned.run, open.name);
    }
    const BenchmarkRecord record = scene_runs.make(planned, part);
    log_.add(record);
    return record.result;
  }

  void judge_submission(const LoadedScene& open, const SceneRuns& scene_runs, std::size_t index) {
    BenchmarkResult result;
    result.entry = submission_names_[index];
    result.scene = open.name;
    result.is_foreign = true;
    const LightField& light_field = *open.scene.light_field;
    std::optional<Estimate> estimate;
    try {
      estimate = read_submission(options_.submissions[index], open.scene, options_.map_reading);
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
      scene_runs.judge_and_write(center, result, progress_);
    }
    report_.results.push_back(std::move(result));
  }

  void search(const LoadedScene& open, SceneRuns& scene_runs, const PlannedRun& planned) {
    const Progress part = workload_.next(search_title(open.name, planned));
    const BenchmarkResult result = find_or_run(open, scene_runs, planned, part);
    report_.searched.push_back({planned.run.method, open.name, planned.point,
                                find_metric(result.vmv2013, "mse_100"), result.seconds,
                                result.problem});
  }

  /// "cotton, epi_l 3 of 12".
  [[nodiscard]] std::string search_title(const std::string& scene,
                                         const PlannedRun& planned) const {
    const auto is_of_method = [&](const PlannedRun& each) {
      return each.run.kind == RunKind::Search && each.index == planned.index;
    };
    const auto first = std::ranges::find_if(runs_, is_of_method);
    return fmt::format("{}, {} {} of {}", scene, planned.run.method, &planned - &*first + 1,
                       std::ranges::count_if(runs_, is_of_method));
  }

  const BenchmarkOptions& options_;
  const SceneLoader& load_;
  const Progress& progress_;
  RunLog log_;
  Workload workload_;
  std::vector<std::string> submission_names_;
  std::vector<PlannedRun> runs_;  ///< On every scene.
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

void Workload::expect(double seconds) {
  ends_.push_back((ends_.empty() ? 0 : ends_.back()) + std::max(seconds, 1e-3));
}

Progress Workload::next(const std::string& title) {
  if (done_ >= ends_.size()) return progress_.part(1, 1).titled(title);
  const double begin = done_ == 0 ? 0 : ends_[done_ - 1];
  const double end = ends_[done_++];
  return progress_.part(begin / ends_.back(), end / ends_.back()).titled(title);
}

void Workload::skip(std::size_t count) {
  done_ = std::min(done_ + count, ends_.size());
  if (done_ > 0) progress_.report(ends_[done_ - 1] / ends_.back());
}

}  // namespace episcope
