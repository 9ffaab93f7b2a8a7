// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/controls/tool_button.h"

#include <QLabel>
#include <QString>
#include <QWidget>

#include <vector>

class QAction;
class QBoxLayout;
class QTreeWidget;

namespace episcope {

/// Disparities measured by hand: a click goes to one, a double click renames it, Delete removes it.
/// Setters never emit; user actions are signals.
class MeasurePanel : public QWidget {
  Q_OBJECT

 public:
  /// A measurement, as text.
  struct Row {
    QString name;
    QString disparity;  ///< "0.42"
    QString depth;      ///< Empty = unknown.
    QString place;      ///< "row 12 · (4, 4)"
    QString tip;
  };

  explicit MeasurePanel(QWidget* parent = nullptr);

  /// Adds a button above the list, or (`addChosenAction`) below it for the chosen measurement, in
  /// order of the calls.
  void addAction(QAction* action) { add_action_button(actions_, action); }
  void addChosenAction(QAction* action);
  void setRows(const std::vector<Row>& rows, int current);
  /// Text shown without measurements.
  void setHint(const QString& hint) { hint_->setText(hint); }
  /// Begins to edit a measurement's name in its row.
  void editName(int index);

 signals:
  void chosen(int index);
  void renameRequested(int index, const QString& name);
  void removeRequested(int index);

 private:
  void setUpList();

  QBoxLayout* actions_;
  QTreeWidget* list_;
  QLabel* hint_;
  QBoxLayout* chosen_actions_;
};

}  // namespace episcope
