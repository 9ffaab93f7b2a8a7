// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"

#include <QMainWindow>
#include <QStringList>

#include <memory>

namespace episcope {

/// Joins the session, the places of the window and the features.
class MainWindow : public QMainWindow {
  Q_OBJECT

 public:
  explicit MainWindow(QWidget* parent = nullptr);
  ~MainWindow() override;

  /// Opens paths and built-in scenes, then lets features offer what an earlier session left
  /// behind.
  void start(const QStringList& inputs);

  /// What features work with.
  [[nodiscard]] const Workbench& bench() const;

 protected:
  void closeEvent(QCloseEvent* event) override;

 private:
  struct Core;

  void addTabCommands();
  void buildBars();
  void restoreLayout();

  std::unique_ptr<Core> core_;
};

}  // namespace episcope
