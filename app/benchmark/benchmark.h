// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/report.h"
#include "engine/core/estimate.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/disparity/estimator.h"
#include "engine/io/models/map_reading.h"
#include "engine/labeling/labeler.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

struct BenchmarkOptions {
  std::vector<std::string> inputs;
  std::vector<Estimator> methods;
  std::vector<std::filesystem::path> submissions;  ///< Folders.
  io::MapReading map_reading{};                    ///< Of their maps.
  std::filesystem::path folder;                    ///< Where everything is written.
  /// Views of the runs for the tables: all gives the times of figure 8. Points of a search always
  /// estimate the center view alone.
  ViewSelection views = ViewSelection::All;
  Device device = Device::Auto;  ///< Methods that cannot use it run on the CPU.
  bool has_search = false;
  std::vector<LabelerParameters> labels;  ///< Ways to label all views from the scene's strokes.
  /// If set, nothing is run, and what the log lacks is a failure. Holds
  /// `LoadedScene::whole_fingerprint` of each input, which must not have changed; empty for
  /// unreadable inputs.
  std::optional<std::vector<std::string>> recorded;
};

/// Opens one of the inputs.
using SceneLoader = std::function<Scene(const std::string& input, const Progress&)>;

/// Runs every method with its default parameters on every scene. Judges methods and submissions in
/// the center view by both protocols, and labels in all views (SceneRuns). With `has_search`, also
/// tries every point of `search_grid`. Writes tables, pictures and maps into the folder, renewed
/// after every scene. One scene is in memory at a time.
///
/// A scene, method, submission or point that fails becomes a sentence in the report; the others
/// continue. A later call takes finished runs from the log of the folder, unless samples, truth,
/// parameters, method or program changed, and tries failed ones again. The program may be ended at
/// any moment. Throws IoError if the folder cannot be written or holds something else, InvalidInput
/// if a recorded scene has changed, Cancelled.
[[nodiscard]] BenchmarkReport run_benchmark(const BenchmarkOptions& options,
                                            const SceneLoader& load, const Progress& progress);

/// Refuses an existing folder that holds anything but a benchmark. Throws IoError.
void check_benchmark_folder(const std::filesystem::path& folder);

/// Divides a progress into items by their expected time, so that the time left is meaningful.
class Workload {
 public:
  explicit Workload(const Progress& progress) : progress_(progress) {}

  /// To be called for every item before the first begins.
  void expect(double seconds);
  [[nodiscard]] Progress next(const std::string& title);
  /// Passes over items that will not be done.
  void skip(std::size_t count);

 private:
  Progress progress_;
  std::vector<double> ends_;  ///< Expected seconds up to the end of each item.
  std::size_t done_ = 0;
};

}  // namespace episcope
