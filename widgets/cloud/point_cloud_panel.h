// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/cloud/cloud_controls.h"
#include "widgets/cloud/cloud_display.h"

#include <QWidget>

class QHBoxLayout;
class QLabel;
class QVBoxLayout;

namespace episcope {

/// The 3D tab: the display with its controls. The display can be lent to another place.
class PointCloudPanel : public QWidget {
  Q_OBJECT

 public:
  explicit PointCloudPanel(QWidget* parent = nullptr);

  [[nodiscard]] CloudDisplay& display() const { return *display_; }
  [[nodiscard]] CloudControls& controls() const { return *controls_; }
  /// Whether a 3D view exists; if not, making clouds is wasted work.
  [[nodiscard]] bool isAvailable() const { return display_->view() != nullptr; }

  /// Something says here where the display is while it is elsewhere. The caller gives it a parent.
  void lendDisplay(const QString& where);
  void takeDisplayBack();
  /// Buttons of commands beside those of the presets.
  void addButton(QWidget* button);

 private:
  void addPresets();

  CloudDisplay* display_;
  CloudControls* controls_;
  QLabel* elsewhere_;
  QHBoxLayout* buttons_;
  QVBoxLayout* rows_;
};

}  // namespace episcope
