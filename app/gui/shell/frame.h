// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/controls/message_bar.h"

#include <QKeySequence>
#include <QObject>
#include <QString>
#include <QVBoxLayout>
#include <QWidget>

#include <functional>
#include <map>
#include <optional>
#include <vector>

class QBoxLayout;
class QSplitter;
class QTabWidget;

namespace episcope {

class Floating;
class Panes;
class Session;

/// A tab on the right, or a page of one: each task has a tab, and what belongs to a task is a page.
struct Tab {
  QString id;  ///< "compare"; its command is "tab.compare".
  QString title;
  QString task{};  ///< Id of the tab, added before, that it is a page of; empty = a tab of its own.
  QString page{};  ///< Of a tab: title of its own page beside other pages; empty = no pages.
  QString command_text;  ///< "Compare tab"
  QString command_tip;
  QString icon{};
  QWidget* widget = nullptr;
  QBoxLayout* room = nullptr;  ///< Where other features may add to it; may be null.
  bool waits = false;          ///< It is not among the tabs until it is asked for.
  /// Key of its command, empty = none. By default Ctrl and its number among the tabs without a key.
  std::optional<QKeySequence> key{};
};

/// Bars below everything else, in order.
enum class Line { Time, Values };

/// The places of the main window, where features put their widgets: the viewer with a column on its
/// left, tabs on the right, and bars below.
class Frame : public QWidget {
  Q_OBJECT

 public:
  explicit Frame(QWidget* parent);

  /// Contains the left column and the viewer area; hears keys of KeyScope::Viewer.
  [[nodiscard]] QWidget* viewer() const { return viewer_; }
  /// Adds a widget to the left column; stretching widgets share the remaining room below the
  /// others.
  void addToColumn(QWidget* widget, bool stretches);
  void setViewerArea(QWidget* viewer_area);
  /// A page moves with the tab of its task, and can also be detached alone.
  void addTab(const Tab& tab);
  /// Adds a widget to the room of a tab; ignored if the tab has none.
  void addToTab(const QString& id, QWidget* widget);
  /// Adds a widget below the tabs.
  void addUnderTabs(QWidget* widget) { right_->addWidget(widget); }
  void addLine(Line line, QWidget* widget);
  /// Adds a widget above everything else.
  void addAbove(QWidget* widget) { rows_->insertWidget(0, widget); }
  /// Adds a widget that floats over the viewer area, so that nothing moves when it appears.
  void addFloating(QWidget* widget);

  /// Shows or hides the left column and the tabs; the viewer area takes their room.
  void setPanelsShown(bool are_shown);
  [[nodiscard]] bool arePanelsShown() const { return !side_->isHidden(); }

  [[nodiscard]] const std::vector<Tab>& tabs() const { return tabs_; }
  void showTab(const QString& id);
  /// Id of the current docked tab, or of its page; empty if all are detached.
  [[nodiscard]] QString shownTab() const;
  /// Detachable parts: the tabs (by "tab.ID"), and panes of features.
  [[nodiscard]] Panes& panes() const { return *panes_; }

  /// Tells features that the program has started: they may offer to recover earlier work.
  void start() { emit started(); }
  /// Tells that the user has decided about an earlier session, if one was left.
  void settle() { emit settled(); }
  /// Restores the default layout; whoever moved widgets follows `layoutReset`.
  void resetLayout() { emit layoutReset(); }
  /// Tells that the window was closed and nothing is to be kept open.
  void end() { emit ended(); }

 signals:
  void started();
  void settled();
  void ended();
  /// A tab is shown, docked or detached.
  void tabShown(const QString& id);
  /// Everything movable returns to its default place.
  void layoutReset();

 private:
  void follow(QTabWidget& book);
  void askWhereTabGoes(const QTabWidget& book, const QPoint& at);
  [[nodiscard]] QTabWidget* makePages(const Tab& task);
  void keepAside(QWidget* pane);
  void fitColumn();
  /// Pages of a task; null if it has none.
  [[nodiscard]] QTabWidget* pagesOf(const Tab& task) const;
  /// Where a tab belongs among those that are in the book now.
  [[nodiscard]] int placeIn(const QTabWidget& book, const Tab& tab) const;
  /// Inserts a tab at its place and shows it.
  void putInBook(const Tab& tab);
  bool raisePane(const QString& id);
  [[nodiscard]] const Tab* findTab(const QString& id) const;
  [[nodiscard]] const Tab* tabOf(const QWidget* widget) const;

  QWidget* viewer_;
  QSplitter* column_;
  int fixed_count_ = 0;  // of widgets in the column that do not stretch; they stand first
  QSplitter* browser_;
  Floating* floating_;  // over the viewer area
  QTabWidget* book_;
  QWidget* side_;  // of the tabs
  QVBoxLayout* right_;
  QVBoxLayout* rows_;
  std::map<Line, QWidget*> lines_;
  std::vector<Tab> tabs_;
  std::map<QString, QTabWidget*> pages_;  // of tasks
  Panes* panes_;
};

/// Messages for the user that float over the view and do not block.
class Messages : public QObject {
  Q_OBJECT

 public:
  Messages(Frame& frame, Session& session);

  /// Tells what to do first; no failure.
  void hint(const QString& sentence) { bar_->showMessage(Severity::Info, sentence); }
  void success(const QString& sentence) { bar_->showMessage(Severity::Success, sentence); }
  void warn(const QString& sentence);
  /// The same with a button that remedies it.
  void warn(const QString& sentence, const QString& button, std::function<void()> run);
  /// Takes the message that is shown away together with the light field that it is about.
  void endWithLightField() { of_light_field_ = bar_->text(); }
  void fail(const QString& sentence) { bar_->showMessage(Severity::Error, sentence); }
  /// Shows "Saved: …".
  void written(const QString& path) { success(tr("Saved: %1").arg(path)); }
  /// Reports an action, with a button that reacts to it.
  void offer(const QString& sentence, const QString& button, std::function<void()> run);
  void dismiss() { bar_->dismiss(); }
  [[nodiscard]] bool isShown(const QString& sentence) const;
  /// Removes a sentence that no longer holds, if it is still shown.
  void retract(const QString& sentence) {
    if (isShown(sentence)) bar_->dismiss();
  }

 private:
  MessageBar* bar_;
  QString of_light_field_;
};

}  // namespace episcope
