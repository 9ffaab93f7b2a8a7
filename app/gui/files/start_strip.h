// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"

#include <QWidget>

class QHBoxLayout;
class QLabel;
class QMenu;

namespace episcope {

/// What to do first, above everything else while the demo is opened or shown: open a light field of
/// one's own, or three steps to try. Gone for good once a light field that is not built in was
/// opened, or its cross was clicked.
class StartStrip : public QWidget {
  Q_OBJECT

 public:
  /// `recent` lists recent inputs and outlives this.
  StartStrip(const Workbench& bench, QMenu* recent);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QLabel* makeSteps();
  void addButtons(QHBoxLayout& row, QMenu* recent);
  void update();

  Workbench bench_;
  bool is_over_ = false;
};

}  // namespace episcope
