// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/open_scene.h"
#include "app/session/point_clouds.h"
#include "widgets/cloud/cloud_look.h"
#include "widgets/cloud/point_cloud_panel.h"

#include <QObject>
#include <QString>

#include <optional>

namespace episcope {

struct EstimateEntry;
class PointCloudPanel;

/// Turns what a user chose of the 3D view into what is to be made of the session, as things are
/// now. What is seen is the shown result; without one, the ground truth.
class CloudRequests {
 public:
  explicit CloudRequests(const Workbench& bench) : bench_(bench) {}

  /// Why nothing can be seen, as a sentence; empty if something can.
  [[nodiscard]] QString obstacle() const;
  /// What can be chosen. Precondition: there is no obstacle.
  [[nodiscard]] CloudOffers offers() const;
  /// Nothing if a map of it is not there yet: its evaluation tells when it is. What cannot be had
  /// is left out. Precondition: there is no obstacle.
  [[nodiscard]] std::optional<PointCloudRequest> request(const CloudChoice& choice) const;
  /// What distances are measured to: "ground truth" or a result.
  [[nodiscard]] QString referenceName(const CloudChoice& choice) const;
  /// What is drawn: "EPI_L", or "EPI_L and ground truth".
  [[nodiscard]] QString title(const CloudChoice& choice) const;
  /// Whose colours a legend explains; none for those of views, labels and sources.
  [[nodiscard]] QString legend(const CloudChoice& choice) const;

 private:
  /// What is shown, if it has a map of this view; the truth stands in for it.
  [[nodiscard]] const EstimateEntry* result() const;
  [[nodiscard]] CloudChoice possible(CloudChoice choice) const;
  [[nodiscard]] std::shared_ptr<const DisparityField> truth() const;
  [[nodiscard]] std::shared_ptr<const DisparityField> other() const;
  [[nodiscard]] std::shared_ptr<const DisparityField> reference(CloudCompanion companion) const;
  /// What is drawn beside the companion.
  [[nodiscard]] std::shared_ptr<const DisparityField> main() const;
  [[nodiscard]] render::Quantity quantity(CloudColoring coloring) const;
  [[nodiscard]] std::optional<MapSource> map(CloudColoring coloring, int estimate) const;
  /// Whether all are there.
  [[nodiscard]] bool addMaps(const CloudChoice& choice, PointCloudRequest& request) const;
  [[nodiscard]] QString otherName() const;

  Workbench bench_;
};

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
  void start(const PointCloudRequest& request);
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
