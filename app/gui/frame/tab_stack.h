// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QTabWidget>

namespace episcope {

class Panes;

/// Panes one over the other, each behind a tab of its own: a second set of tabs below those of the
/// window, for what the user puts there. Hidden while it is empty. The cross of a tab brings its
/// pane back to its place, a double click gives it a window of its own.
class TabStack : public QTabWidget {
  Q_OBJECT

 public:
  explicit TabStack(QWidget* parent);

  /// `panes` outlives this.
  void serve(Panes& panes);
  /// Adds a pane, which is then in front, and is scrolled where there is little room.
  void take(QWidget* pane, const QString& title);
  void bringToFront(QWidget* pane);
  [[nodiscard]] bool isInFront(const QWidget* pane) const;
  /// The pane is for somebody else to place.
  void release(QWidget* pane);

 private:
  void takeHalf();
  void askWhereTabGoes(const QPoint& at);
  [[nodiscard]] QString paneAt(int index) const;
  /// −1 if it is not here.
  [[nodiscard]] int placeOf(const QWidget* pane) const;

  Panes* panes_ = nullptr;
};

}  // namespace episcope
