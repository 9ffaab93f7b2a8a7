// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "app/session/live_estimator.h"
#include "app/session/open_scene.h"
#include "engine/render/quantity.h"

#include <QObject>
#include <QString>

#include <optional>

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
  [[nodiscard]] QString status() const;

  Workbench bench_;
  MethodPanel& method_;
  bool is_on_ = false;
  bool is_up_ = false;
  EstimatePtr map_;                         // that the session has
  std::optional<render::Quantity> before_;  // drawn before the map was brought up
  LiveEstimator estimator_;
};

}  // namespace episcope
