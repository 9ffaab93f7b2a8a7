// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/workbench.h"
#include "app/session/open_scene.h"
#include "app/session/session.h"

#include <QKeySequence>
#include <QObject>
#include <QString>

namespace episcope {

class EpiPane;
class MeasurePanel;

/// Disparities measured by lines in EPIs: lists, revisits, focuses and writes them.
class MeasureController : public QObject {
  Q_OBJECT

 public:
  explicit MeasureController(const Workbench& bench);

  /// Keeps the line drawn last.
  void keep();
  /// Goes to a measurement of the list and draws its line.
  void choose(int index);

 private:
  struct Row {
    const char* id;
    QString text;
    QString tip;
    const char* icon;
    void (MeasureController::*run)();
    QKeySequence key = {};
  };
  void addCommands();
  void addCommand(const Row& row);
  void connectPanel();
  void update(Parts parts) {
    if (parts.has_any(Part::Measured | Part::Scene)) show();
  }
  void show();
  void showLine();
  void rename(int index, const QString& name);
  void remove(int index);
  void removeCurrent() { remove(measured().current); }
  void nameCurrent();
  void focusOnCurrent() { bench_.session.set_focus(current_of(measured())->disparity_px); }
  void copy();
  void save();
  [[nodiscard]] std::string csv() const;
  [[nodiscard]] EpiPane* pane(EpiDirection direction) const;
  [[nodiscard]] const Measurements& measured() const { return bench_.session.place().measured; }
  [[nodiscard]] QString nextName() const;

  Workbench bench_;
  MeasurePanel* panel_;
  EpiDirection drawn_ = EpiDirection::Horizontal;  // of the line that was drawn last
};

}  // namespace episcope
