// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"

#include <QLabel>
#include <QString>
#include <QWidget>

#include <cstdint>
#include <map>
#include <set>
#include <vector>

class QLineEdit;
class QToolButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace episcope {

/// The labels: color, id, name, amount, visibility and lock of each, with the current one marked.
/// A click makes a label current; a click on its color, eye or lock changes that; a double click
/// renames it; Delete removes it; a drag moves it in the list. Setters never emit; user actions are
/// signals.
class LabelPalette : public QWidget {
  Q_OBJECT

 public:
  explicit LabelPalette(QWidget* parent = nullptr);

  void setLabels(const std::vector<LabelInfo>& labels);
  /// 0 = none.
  void setCurrent(int id);
  void setHidden(const std::set<std::int32_t>& ids);
  void setLocked(const std::set<std::int32_t>& ids);
  /// Amount of a label: short for its row, long for its tool tip.
  struct Amount {
    QString text;
    QString tip;
  };
  /// Amounts by id; labels without an entry have none.
  void setAmounts(const std::map<std::int32_t, Amount>& amounts);
  /// Text shown instead of an empty list.
  void setHint(const QString& hint) { hint_->setText(hint); }
  /// Begins to edit a label's name in its row.
  void editName(int id);

  [[nodiscard]] int current() const { return current_; }

 signals:
  void currentChosen(int id);
  void addRequested();
  void renameRequested(int id, const QString& name);
  void colorRequested(int id);
  void numberRequested(int id);
  void mergeRequested(int id);
  /// Down the list by so many places.
  void moveRequested(int id, int by);
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
  void filter();
  void showMarks();
  bool clickMark(QPoint position);
  void dropAt(QPoint position);
  void updateButtons();
  [[nodiscard]] QTreeWidgetItem* itemOf(int id) const;

  QLineEdit* filter_;
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
