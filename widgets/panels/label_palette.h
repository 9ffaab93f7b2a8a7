// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/label_info.h"

#include <QColor>
#include <QString>
#include <QWidget>

#include <cstdint>
#include <map>
#include <set>
#include <vector>

class QLabel;
class QToolButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace episcope {

/// The labels that can be painted with: colour, id, name and amount of each, whether it is shown
/// and locked, the current one marked. A click makes a label the current one, a click on its colour
/// asks for another colour, one on its eye or lock hides or locks it, a double click renames it in
/// its row, Delete removes it. Setters never emit; what the user wants is a signal.
class LabelPalette : public QWidget {
  Q_OBJECT

 public:
  explicit LabelPalette(QWidget* parent = nullptr);

  void setLabels(const std::vector<LabelInfo>& labels);
  /// 0 = none.
  void setCurrent(int id);
  /// Ids of the labels that are not shown, and of those that cannot be painted.
  void setHidden(const std::set<std::int32_t>& ids);
  void setLocked(const std::set<std::int32_t>& ids);
  /// How much there is of a label, in its row and in full as its tool tip.
  struct Amount {
    QString text;
    QString tip;
  };
  /// By id; labels that are not among them have none.
  void setAmounts(const std::map<std::int32_t, Amount>& amounts);
  /// Shown instead of an empty list.
  void setHint(const QString& hint);
  /// Begins to edit the name of a label in its row.
  void editName(int id);

  [[nodiscard]] int current() const { return current_; }

 signals:
  void currentChosen(int id);
  void addRequested();
  void renameRequested(int id, const QString& name);
  void colorRequested(int id);
  void removeRequested(int id);
  void hiddenRequested(int id, bool hides);
  void onlyRequested(int id);
  void lockedRequested(int id, bool locks);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void setUpTree();
  void setUpActions();
  void showMenu(const QPoint& position);
  void markCurrent();
  void showMarks();
  bool clickMark(QPoint position);
  void updateButtons();
  [[nodiscard]] QTreeWidgetItem* itemOf(int id) const;

  QTreeWidget* tree_;
  QLabel* hint_;
  QToolButton* add_;
  QToolButton* rename_;
  QToolButton* remove_;
  std::vector<LabelInfo> labels_;
  std::set<std::int32_t> hidden_;
  std::set<std::int32_t> locked_;
  std::map<std::int32_t, Amount> amounts_;
  int current_ = 0;
};

}  // namespace episcope
