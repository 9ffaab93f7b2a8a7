// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QHash>
#include <QObject>
#include <QString>
#include <QStringList>
#include <QTabWidget>
#include <QWidget>

#include <functional>
#include <vector>

class QWidget;

namespace episcope {

class PaneWindow;
class TabStack;

/// A part of the window that can be elsewhere.
struct Pane {
  QString id;
  QString title;
  QWidget* widget = nullptr;
  std::function<void()> put_back;  ///< Gives the widget its place in the main window again.
};

/// The panes that can be torn off, or stacked one over the other behind tabs of their own. Those
/// that are torn off stay above the main window, hear its keys, and come back when their own window
/// is closed.
class Panes : public QObject {
  Q_OBJECT

 public:
  /// `home` is in the main window, and outlives this.
  explicit Panes(QWidget& home);
  ~Panes() override;

  /// Where panes are stacked; nowhere without it. Outlives this.
  void setStack(TabStack* stack);
  void add(Pane pane);
  [[nodiscard]] bool isTorn(const QString& id) const { return windows_.contains(id); }
  [[nodiscard]] bool isStacked(const QString& id) const { return stacked_.contains(id); }
  /// Opens a window of its own, where and as large as it was the last time. Raises it if there is
  /// one. Ignored for an unknown id.
  void tear(const QString& id);
  /// Whether it is in front where it is. False for an unknown id.
  [[nodiscard]] bool isSeen(const QString& id) const;
  /// Puts it behind a tab of the stack, and shows it there. Ignored for an unknown id.
  void stack(const QString& id);
  /// Back to its own place; ignored if it is there.
  void putBack(const QString& id);
  void toggle(const QString& id);
  void toggleStacked(const QString& id);
  /// Of what is behind a tab of the stack; empty for another widget.
  [[nodiscard]] QString stackedPane(const QWidget* widget) const;

  /// Remembers in the settings which are elsewhere; `restore` puts them there again.
  void save() const;
  void restore();
  /// All come back, and their places are forgotten.
  void reset();

 signals:
  /// It is elsewhere.
  void changed(const QString& id);
  /// A window was opened, which should hear the keys of the viewer.
  void opened(QWidget* window);

 private:
  [[nodiscard]] const Pane* find(const QString& id) const;
  void leave(const QString& id);
  void remember(const QString& id) const;

  QWidget& home_;
  std::vector<Pane> panes_;
  TabStack* stack_ = nullptr;
  QHash<QString, PaneWindow*> windows_;
  QStringList stacked_;
};

/// A window that holds one pane of another window.
class PaneWindow : public QWidget {
  Q_OBJECT

 public:
  /// Takes the widget, and stays above `owner`.
  PaneWindow(QWidget* widget, const QString& title, QWidget* owner);

 signals:
  /// The user closed it; it still holds the pane.
  void closed();

 protected:
  void closeEvent(QCloseEvent* event) override;
};

/// The main window of a widget: that of the owner where the widget is in a torn-off pane.
[[nodiscard]] const QWidget* main_window_of(const QWidget& widget);

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
