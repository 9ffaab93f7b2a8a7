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

/// What a form asks for.
[[nodiscard]] ViewSelection views_of(bool all_views);
[[nodiscard]] EstimateRequest request_of(const RunRequest& request);

/// Runs methods on open scenes in the background, one after the other. Results go to their scenes,
/// whichever is shown by then; runs on scenes that are closed are cancelled.
class MethodRuns : public QObject {
  Q_OBJECT

 public:
  explicit MethodRuns(const Workbench& bench);

  /// A scene that is on disk only is read for it.
  void run(const EstimateRequest& request, const OpenScene& scene);
  /// Whether a method runs, or waits, on the open scene of this id.
  [[nodiscard]] bool isRunning(std::uint64_t scene) const;
  /// Of all runs on it.
  [[nodiscard]] std::vector<quint64> jobsOn(std::uint64_t scene) const;

 signals:
  /// A run began or ended.
  void changed();

 private:
  void cancelClosed();

  Workbench bench_;
  std::map<quint64, std::uint64_t> runs_;  // jobs and the scenes they run on
};

/// Gives a worker an open scene: what is in memory, else it is read. Throws what `load_scene`
/// throws.
using SceneSource = std::function<std::shared_ptr<const Scene>(const Progress&)>;

/// `cache` keeps built-in scenes. Without `needs_truth`, what is read may lack its ground truth.
[[nodiscard]] SceneSource scene_source(const OpenScene& scene, const std::filesystem::path& cache,
                                       bool needs_truth);

}  // namespace episcope
