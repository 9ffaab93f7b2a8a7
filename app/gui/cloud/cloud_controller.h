// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "app/gui/cloud/cloud_request.h"
#include "app/gui/frame/jobs.h"
#include "app/session/parts.h"
#include "widgets/cloud/cloud_look.h"

#include <QObject>
#include <QString>

#include <optional>

namespace episcope {

class PointCloudPanel;

/// The 3D view: makes it when it is shown first, keeps its clouds up to date while it is on screen
/// and lets go of them when they are out of date and it is not; ties its points to the cross-hair;
/// puts it in the place of the view and back.
class CloudController : public QObject {
  Q_OBJECT

 public:
  CloudController(const Workbench& bench, QWidget* tab);

  /// In the place of the view, else in its tab.
  void setLarge(bool is_large);
  [[nodiscard]] bool isLarge() const { return is_large_; }
  /// Asks for a file and writes what is seen.
  void askToExport() const;
  [[nodiscard]] bool hasScene() const { return parts_ && !parts_->empty(); }

 private:
  /// What became of a request.
  struct Made {
    CloudPartsPtr parts;
    std::optional<CloudDistance> distance;
    std::optional<render::Shading> shading;
  };

  void hear(Parts parts);
  void makePanel();
  void connectPanel();
  void remember() const;
  void refresh();
  void update();
  void showHint(const QString& hint);
  void start(const SpaceRequest& request);
  void show(const Made& made);
  [[nodiscard]] bool isOnScreen() const;
  [[nodiscard]] QString summary(const Made& made) const;

  Workbench bench_;
  Session& session_;
  CloudRequests requests_;
  QWidget* tab_;
  PointCloudPanel* panel_ = nullptr;
  CloudPartsPtr parts_;
  bool is_large_ = false;
  bool is_stale_ = true;
  LatestJob job_;
};

}  // namespace episcope
