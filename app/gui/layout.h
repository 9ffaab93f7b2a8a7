// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "app/gui/frame/layout_memory.h"

#include <QMainWindow>
#include <QObject>

namespace episcope {

/// How the window is divided: full screen, side panels, panes in windows of their own, sizes; with
/// the commands for that, and kept in the settings.
class Layout : public QObject {
  Q_OBJECT

 public:
  /// After all tabs were added.
  Layout(const Workbench& bench, QMainWindow& window);

  void save() const;
  void restoreSizes() const { sizes_.restore(); }

 private:
  void addScreenCommands();
  void addPaneCommands();
  void addStackCommands();
  void reset();
  void toggleFullScreen();

  Workbench bench_;
  QMainWindow& window_;
  LayoutMemory sizes_;
};

}  // namespace episcope
