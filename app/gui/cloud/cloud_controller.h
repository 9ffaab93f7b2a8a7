// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "app/gui/frame/jobs.h"
#include "app/session/picture/map_source.h"
#include "engine/render/shade.h"

#include <QObject>

#include <optional>

namespace episcope {

class PointCloudPanel;

/// The 3D tab: makes it when it is shown first, keeps its cloud up to date while it is on screen,
/// and moves the cross-hair to points that are clicked.
class CloudController : public QObject {
  Q_OBJECT

 public:
  CloudController(const Workbench& bench, QWidget* tab);

 private:
  /// Colours of the points, where they are not those of the image.
  struct Coloring {
    MapSource source;
    render::Shading shading;
  };

  void makePanel();
  void update();
  void startCloud(const std::optional<Coloring>& coloring);
  [[nodiscard]] std::optional<Coloring> coloring() const;
  [[nodiscard]] bool isOnScreen() const;
  [[nodiscard]] QString obstacle() const;

  Workbench bench_;
  Session& session_;
  QWidget* tab_;
  PointCloudPanel* panel_ = nullptr;
  bool is_stale_ = true;
  LatestJob job_;
};

}  // namespace episcope
