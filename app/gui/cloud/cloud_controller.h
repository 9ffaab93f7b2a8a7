// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/frame/frame.h"
#include "app/gui/frame/jobs.h"
#include "app/gui/stage/overlay.h"
#include "app/session/session.h"

#include <QObject>

namespace episcope {

class PointCloudPanel;

/// The 3D tab: makes it when it is shown first, and keeps its cloud up to date while it is on
/// screen.
class CloudController : public QObject {
  Q_OBJECT

 public:
  CloudController(Session& session, const OverlayController& overlay, const Panels& panels,
                  QObject* parent);

 private:
  void makePanel();
  void update();
  [[nodiscard]] bool isOnScreen() const;
  [[nodiscard]] QString obstacle() const;

  Session& session_;
  const OverlayController& overlay_;
  Panels panels_;
  PointCloudPanel* panel_ = nullptr;
  bool is_stale_ = true;
  LatestJob job_;
};

}  // namespace episcope
