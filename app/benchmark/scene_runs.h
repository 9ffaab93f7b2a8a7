// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/benchmark.h"
#include "app/benchmark/run_log.h"
#include "app/session/judge.h"
#include "app/session/labeling_inputs.h"
#include "app/session/segmentation.h"
#include "engine/core/estimate.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/labeling/labeler.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace episcope {

/// A scene of a benchmark while it is in memory.
struct LoadedScene {
  Scene scene;
  std::string name;   ///< Unique in the benchmark.
  std::string input;  ///< As it was asked for.
  std::string fingerprint;
  std::string labels_fingerprint;  ///< With all that labels depend on; empty unless wanted.
  Interval range;

  /// 16 hexadecimal digits that change with all that the runs of a benchmark depend on.
  [[nodiscard]] std::string whole_fingerprint() const;
};

/// Opens an input; its name differs from all that are `taken`. Throws what `load` throws.
[[nodiscard]] LoadedScene open_benchmark_scene(const BenchmarkOptions& options,
                                               const std::string& input, const SceneLoader& load,
                                               const std::set<std::string>& taken,
                                               const Progress& progress);

/// Throws InvalidInput if the scene is not the one that had this fingerprint when a plan was made.
void require_unchanged(const LoadedScene& open, const std::string& whole_fingerprint);

/// `wanted`, with a number behind it if that is taken.
[[nodiscard]] std::string unused_name(const std::string& wanted,
                                      const std::set<std::string>& taken);

/// A run that a benchmark makes on every scene.
struct PlannedRun {
  BenchmarkRun run;
  std::size_t index = 0;  ///< Of the method, for labels of the way, in the options.
  ParameterSet point{};   ///< Of a search: the parameters that are searched.
};

/// All runs on a scene: methods for the tables, ways to label, then point by point the search of
/// each method. Searches need a true disparity.
[[nodiscard]] std::vector<PlannedRun> planned_runs(const BenchmarkOptions& options);

/// Makes the runs of a benchmark on one scene; borrows both.
class SceneRuns {
 public:
  SceneRuns(const BenchmarkOptions& options, const LoadedScene& open);

  /// Names the result of a run on this scene (`record_key`).
  [[nodiscard]] std::string key(const BenchmarkRun& run) const;

  /// Runs, judges and, unless it is a point of a search, writes map and pictures. What fails is the
  /// problem of the result. Throws Cancelled.
  [[nodiscard]] BenchmarkRecord make(const PlannedRun& planned, const Progress& progress);

  /// Judges the center view by both protocols and writes its pictures, which are returned. Throws
  /// IoError, Cancelled.
  std::vector<std::string> judge_and_write(const EstimatePtr& center, BenchmarkResult& result,
                                           const Progress& progress) const;

 private:
  void run_and_judge(const Estimator& method, const Progress& progress, BenchmarkRecord& record);
  void label_and_judge(const LabelerParameters& way, const Progress& progress,
                       BenchmarkRecord& record);
  [[nodiscard]] const LabelingDisparity& disparity_for(const LabelerParameters& way,
                                                       const Progress& progress);

  const BenchmarkOptions& options_;
  const LoadedScene& open_;
  std::map<bool, LabelingDisparity> disparities_;  // by whether they are true
};

/// Files of a benchmark, named below its folder. All are written atomically; all functions that
/// write throw IoError.

/// "scenes/cotton/view.png": `what` may be "view", "truth", "labels".
[[nodiscard]] std::string scene_file(const std::string& scene, const std::string& what);
/// "scenes/cotton/epi_l-error.png": `what` may be "disparity", "error", "labels",
/// "wrong".
[[nodiscard]] std::string picture_file(const std::string& scene, const std::string& entry,
                                       const std::string& what);
/// "scenes/cotton/epi_l.h5".
[[nodiscard]] std::string map_file(const std::string& scene, const std::string& entry);

/// Writes pictures of the center view and of its true disparity; returns whether there is one.
bool write_scene_pictures(const std::filesystem::path& folder, const std::string& name,
                          const Scene& scene, Interval range);

/// Pictures of an estimate of the center view alone (`center_of`) and, unless `evaluation` is null,
/// of its error. Returns what was written.
std::vector<std::string> write_pictures(const std::filesystem::path& folder,
                                        const std::string& scene, const EstimatePtr& center,
                                        const std::string& entry, const EvaluationPtr& evaluation,
                                        Interval range);

/// Writes a picture of the true labels of the center view; returns whether it has any.
bool write_label_truth(const std::filesystem::path& folder, const std::string& name,
                       const Scene& scene);

/// The center view of an estimate, with a note if its seconds are for all views.
[[nodiscard]] Estimate center_of(const Estimate& estimate, ViewIndex center);

}  // namespace episcope
