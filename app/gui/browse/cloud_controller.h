// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/open_scene.h"
#include "app/session/picture.h"
#include "widgets/cloud/cloud_look.h"
#include "widgets/cloud/point_cloud_panel.h"

#include <QObject>
#include <QString>

#include <optional>

namespace episcope {

/// Turns a choice of the 3D view into a request to the session in its current state. Shows the
/// current result, or the ground truth if there is none.
class CloudRequests {
 public:
  explicit CloudRequests(const Workbench& bench) : bench_(bench) {}

  /// Sentence that tells why there is nothing to show; empty if there is.
  [[nodiscard]] QString obstacle() const;
  /// Available choices. Precondition: there is no obstacle.
  [[nodiscard]] CloudOffers offers() const;
  /// Request for the choice; none until its maps exist, which their evaluation announces. Leaves
  /// out what is unavailable. Precondition: there is no obstacle.
  [[nodiscard]] std::optional<PointCloudRequest> request(const CloudChoice& choice) const;
  /// Reference of distances: "ground truth" or a result.
  [[nodiscard]] QString referenceName(const CloudChoice& choice) const;
  /// Name of the drawn clouds: "EPI_L", or "EPI_L and ground truth".
  [[nodiscard]] QString title(const CloudChoice& choice) const;
  /// Quantity whose colors need a legend; none for colors of views, labels and sources.
  [[nodiscard]] QString legend(const CloudChoice& choice) const;

 private:
  /// The shown result if it has a map of this view; the truth replaces it otherwise.
  [[nodiscard]] const EstimateEntry* result() const;
  [[nodiscard]] CloudChoice possible(CloudChoice choice) const;
  [[nodiscard]] std::shared_ptr<const DisparityField> truth() const;
  [[nodiscard]] std::shared_ptr<const DisparityField> other() const;
  [[nodiscard]] std::shared_ptr<const DisparityField> reference(CloudCompanion companion) const;
  /// Source that is drawn beside the companion.
  [[nodiscard]] std::shared_ptr<const DisparityField> main() const;
  [[nodiscard]] render::Quantity quantity(CloudColoring coloring) const;
  [[nodiscard]] std::optional<MapSource> map(CloudColoring coloring, int estimate) const;
  /// Returns whether all maps exist.
  [[nodiscard]] bool addMaps(const CloudChoice& choice, PointCloudRequest& request) const;
  [[nodiscard]] QString otherName() const;

  Workbench bench_;
};

/// The 3D view. Creates it when first shown, updates its clouds while it is visible, and drops
/// outdated clouds while it is not. Links its points to the cross-hair, and moves it in place of
/// the view and back.
class CloudController : public QObject {
  Q_OBJECT

 public:
  CloudController(const Workbench& bench, QWidget* tab);

  /// Shows the 3D view in place of the view, or in its tab.
  void setLarge(bool is_large);
  [[nodiscard]] bool isLarge() const { return is_large_; }
  /// Asks for a file and writes the shown clouds.
  void askToExport() const;
  [[nodiscard]] bool hasScene() const { return parts_ && !parts_->empty(); }

 private:
  /// Outcome of a request.
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
  [[nodiscard]] bool isOnScreen() const { return panel_ && panel_->display().isVisible(); }
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
