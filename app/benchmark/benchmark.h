// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/benchmark/report.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/disparity/estimator.h"
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
  std::vector<std::filesystem::path> submissions;  ///< Folders, see submission.h.
  std::filesystem::path folder;                    ///< Where everything is written.
  /// Views of the runs for the tables: all gives the times of figure 8. Points of a search always
  /// estimate the centre view alone.
  ViewSelection views = ViewSelection::All;
  Device device = Device::Auto;  ///< Cuda is for the methods that can; the others stay on the CPU.
  bool has_search = false;
  std::vector<LabelerParameters> labels;  ///< Ways to label all views from the scene's strokes.
  /// Nothing is run: what the log lacks is a failure. `LoadedScene::whole_fingerprint` of each
  /// input, of which none may have changed; empty for those that could not be read.
  std::optional<std::vector<std::string>> recorded;
};

/// Opens one of the inputs.
using SceneLoader = std::function<Scene(const std::string& input, const Progress&)>;

/// Runs every method with its default parameters on every scene, judges it and the submissions in
/// the centre view by both protocols, labels in all views (label_runs.h), with `has_search` also
/// tries every point of `search_grid`, and writes tables, pictures and maps into the folder,
/// renewed after every scene. One scene is in memory at a time.
///
/// What fails (a scene, a method, a submission, a point) is a sentence in the report, the others go
/// on. Finished runs are in the log of the folder and are not computed again by a later call,
/// unless samples, truth, parameters, method or program changed; failed ones are tried again. The
/// program may be ended at any moment. Throws IoError if the folder cannot be written or holds
/// something else, InvalidInput if a recorded scene has changed, Cancelled.
[[nodiscard]] BenchmarkReport run_benchmark(const BenchmarkOptions& options,
                                            const SceneLoader& load, const Progress& progress);

/// Refuses a folder that is there and holds other things than a benchmark. Throws IoError.
void check_benchmark_folder(const std::filesystem::path& folder);

/// Divides a progress into items by the time that each is expected to take, so that the time left
/// means something.
class Workload {
 public:
  explicit Workload(const Progress& progress) : progress_(progress) {}

  /// To be called for every item before the first begins.
  void expect(double seconds);
  /// The part of the next item, titled.
  [[nodiscard]] Progress next(const std::string& title);
  /// Passes over items that will not be done.
  void skip(std::size_t count);

 private:
  Progress progress_;
  std::vector<double> ends_;  ///< Expected seconds up to the end of each item.
  std::size_t done_ = 0;
};

}  // namespace episcope
