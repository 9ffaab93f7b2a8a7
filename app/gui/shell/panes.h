// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QHash>
#include <QObject>
#include <QSplitter>
#include <QString>
#include <QStringList>
#include <QTabWidget>
#include <QWidget>

#include <functional>
#include <utility>
#include <vector>

class QKeyEvent;
class QSplitter;

namespace episcope {

class PaneWindow;
class TabStack;

/// A part of the window that can be detached or stacked.
struct Pane {
  QString id;
  QString title;
  QWidget* widget = nullptr;
  std::function<void()> put_back;  ///< Gives the widget its place in the main window again.
  QWidget* face = nullptr;         ///< The part that is seen or not; null = the widget.
};

/// Panes that can be detached into windows, or stacked behind tabs. Detached panes stay above the
/// main window, hear its keys, and dock again when their window is closed.
class Panes : public QObject {
  Q_OBJECT

 public:
  /// `home` is in the main window and outlives this.
  explicit Panes(QWidget& home);
  ~Panes() override;

  /// Sets where panes are stacked; without it they cannot be. Outlives this.
  void setStack(TabStack* stack);
  void add(Pane pane) { panes_.push_back(std::move(pane)); }
  [[nodiscard]] bool isTorn(const QString& id) const { return windows_.contains(id); }
  [[nodiscard]] bool isStacked(const QString& id) const { return stacked_.contains(id); }
  /// Detaches a pane into a window with its last geometry; raises that window if it exists. Ignores
  /// unknown ids.
  void tear(const QString& id);
  /// Whether the pane is visible at its place, and no other page in front of it; also while the
  /// place is hidden as a whole. False for an unknown id.
  [[nodiscard]] bool isSeen(const QString& id) const;
  /// Stacks a pane behind a tab and shows it there. Ignores unknown ids.
  void stack(const QString& id);
  /// Docks a pane at its default place.
  void putBack(const QString& id);
  void toggle(const QString& id) { isTorn(id) ? putBack(id) : tear(id); }
  void toggleStacked(const QString& id) { isStacked(id) ? putBack(id) : stack(id); }
  /// Id of a stacked pane; empty for another widget.
  [[nodiscard]] QString stackedPane(const QWidget* widget) const;

  /// Stores in the settings which panes are detached or stacked; `restore` applies that.
  void save() const;
  void restore();
  /// Docks all panes and forgets their places.
  void reset();

 signals:
  /// A pane was moved.
  void changed(const QString& id);
  /// A window was opened, which should hear the viewer's keys.
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

/// Tells of each new size once its parts are in their places.
class ToldSplitter : public QSplitter {
 public:
  explicit ToldSplitter(std::function<void()> resized)
      : QSplitter(Qt::Horizontal), resized_(std::move(resized)) {}

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QSplitter::resizeEvent(event);
    resized_();
  }

 private:
  std::function<void()> resized_;
};

/// Whether a splitter divides its room by a rule until the user drags in it. Then its sizes are not
/// worth remembering. False by default.
[[nodiscard]] bool is_divided_by_itself(const QSplitter& splitter);
void set_divided_by_itself(QSplitter& splitter, bool is_by_itself);

/// A second set of tabs below the window's tabs, for stacked panes. Hidden while empty. A tab's
/// cross docks its pane; a double click detaches it.
class TabStack : public QTabWidget {
  Q_OBJECT

 public:
  explicit TabStack(QWidget* parent);

  /// `panes` outlives this.
  void serve(Panes& panes);
  /// Adds a pane in front; it scrolls if there is little room.
  void take(QWidget* pane, const QString& title);
  void bringToFront(QWidget* pane) { setCurrentIndex(placeOf(pane)); }
  /// Removes a pane, for others to place.
  void release(QWidget* pane);

 private:
  void takeHalf();
  void askWhereTabGoes(const QPoint& at);
  [[nodiscard]] QString paneAt(int index) const;
  /// −1 if the pane is not here.
  [[nodiscard]] int placeOf(const QWidget* pane) const;

  Panes* panes_ = nullptr;
};

/// Keeps the keyboard focus on the view, so that browsing keys always work: clicking a button,
/// list, slider or tab leaves the focus alone. A text field takes the focus, and returns it on
/// Return, or on Esc, which drops the input. Tab still reaches controls; arrows are theirs then.
class KeyboardHome : public QObject {
  Q_OBJECT

 public:
  /// `home` returns the widget that owns the keyboard. Both outlive this.
  KeyboardHome(QWidget& window, std::function<QWidget*()> home);

  /// Returns the focus to the view, unless it is in a field or a tab bar.
  void goHomeFromControls();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  [[nodiscard]] bool isOfWindow(const QObject* watched) const;
  static void greet(QWidget& widget);
  void endTyping(const QWidget& clicked);
  bool hear(QWidget& widget, QKeyEvent& key);
  [[nodiscard]] static bool belongsTo(const QWidget& widget, const QKeyEvent& key);
  void leave(QWidget& field, int key);
  void goHome();

  QWidget& window_;
  std::function<QWidget*()> home_;
};

}  // namespace episcope
