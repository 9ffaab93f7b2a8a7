// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "app/session/live_estimator.h"
#include "app/session/open_scene.h"
#include "app/session/run_estimator.h"
#include "engine/core/progress.h"
#include "engine/render/quantity.h"

#include <QObject>
#include <QString>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace episcope {

class MethodPanel;

/// The live estimate: while on, every change of method, parameters, view or visible part yields a
/// new map, shown in place of the current result and not kept.
class LiveController : public QObject {
  Q_OBJECT

 public:
  LiveController(const Workbench& bench, MethodPanel& method);

  void setOn(bool is_on);
  [[nodiscard]] const LiveEstimator& estimator() const { return estimator_; }

 private:
  void addCommand();
  void update(Parts parts);
  /// Requests a map of the visible part.
  void follow();
  [[nodiscard]] std::optional<LiveRequest> request() const;
  void show();
  /// Shows the map even if no overlay was shown before.
  void bringUp();
  /// Restores the previous overlay.
  void giveBack();
  void showStatus();
  /// Shows the running estimate among the jobs.
  void showJob();
  [[nodiscard]] QString status() const;

  Workbench bench_;
  MethodPanel& method_;
  bool is_on_ = false;
  bool is_up_ = false;
  quint64 job_ = 0;
  EstimatePtr map_;                         // that the session has
  std::optional<render::Quantity> before_;  // drawn before the map was brought up
  LiveEstimator estimator_;
};

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

  /// Loads a scene that is only on disk. Nobody is asked to save a result that was not asked for.
  void run(const EstimateRequest& request, const OpenScene& scene, bool was_asked_for = true);
  /// Whether a method runs, or waits, on this open scene.
  [[nodiscard]] bool isRunning(std::uint64_t scene) const;
  /// Jobs of all runs on the scene.
  [[nodiscard]] std::vector<quint64> jobsOn(std::uint64_t scene) const;
  /// Shows a result of the scene in front, in a view that it has.
  void show(int estimate);

 signals:
  /// A run began or ended.
  void changed();

 private:
  void cancelClosed();
  /// Whether the tab that compares is in front, and shows this open scene.
  [[nodiscard]] bool isComparing(std::uint64_t scene) const;
  /// Tells of a result that came while others were compared, or something else was looked at.
  void offerToShow(int estimate);
  /// Takes the offer back once its result was seen or removed.
  void endOffer();

  Workbench bench_;
  std::map<quint64, std::uint64_t> runs_;  // jobs and the scenes they run on
  std::pair<int, QString> offered_{};      // a new result, and the sentence that offers it
};

/// Gives a worker an open scene, loading it if necessary. Throws what `load_scene` throws.
using SceneSource = std::function<std::shared_ptr<const Scene>(const Progress&)>;

/// `cache` holds built-in scenes. Without `needs_truth`, a loaded scene may lack its ground truth.
[[nodiscard]] SceneSource scene_source(const OpenScene& scene, const std::filesystem::path& cache,
                                       bool needs_truth);

}  // namespace episcope
