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

/// The live estimate: while it is on, every change of method, parameters, view or of what is in
/// sight is answered by a new map, which is looked at in the place of the shown result and kept
/// nowhere.
class LiveController : public QObject {
  Q_OBJECT

 public:
  LiveController(const Workbench& bench, MethodPanel& method);

  void setOn(bool is_on);
  [[nodiscard]] bool isOn() const { return is_on_; }
  [[nodiscard]] const LiveEstimator& estimator() const { return estimator_; }

 private:
  void addCommand();
  void update(Parts parts);
  /// Asks for what is looked at now.
  void follow();
  [[nodiscard]] std::optional<LiveRequest> request() const;
  void show();
  /// A map is seen even if none was before.
  void bringUp();
  /// What was drawn before it.
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
