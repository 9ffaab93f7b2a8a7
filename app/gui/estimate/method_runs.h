// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "app/session/open_scene.h"
#include "app/session/run_estimator.h"
#include "engine/core/progress.h"

#include <QObject>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace episcope {

struct RunRequest;

/// Views that a form requests.
[[nodiscard]] ViewSelection views_of(bool all_views);
[[nodiscard]] EstimateRequest request_of(const RunRequest& request);

/// Runs methods on open scenes in the background, one after the other. Results go to their scenes
/// even if another is shown; closing a scene cancels its runs.
class MethodRuns : public QObject {
  Q_OBJECT

 public:
  explicit MethodRuns(const Workbench& bench);

  /// Loads a scene that is only on disk.
  void run(const EstimateRequest& request, const OpenScene& scene);
  /// Whether a method runs, or waits, on this open scene.
  [[nodiscard]] bool isRunning(std::uint64_t scene) const;
  /// Jobs of all runs on the scene.
  [[nodiscard]] std::vector<quint64> jobsOn(std::uint64_t scene) const;

 signals:
  /// A run began or ended.
  void changed();

 private:
  void cancelClosed();

  Workbench bench_;
  std::map<quint64, std::uint64_t> runs_;  // jobs and the scenes they run on
};

/// Gives a worker an open scene, loading it if necessary. Throws what `load_scene` throws.
using SceneSource = std::function<std::shared_ptr<const Scene>(const Progress&)>;

/// `cache` holds built-in scenes. Without `needs_truth`, a loaded scene may lack its ground truth.
[[nodiscard]] SceneSource scene_source(const OpenScene& scene, const std::filesystem::path& cache,
                                       bool needs_truth);

}  // namespace episcope
