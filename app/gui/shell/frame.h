// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QKeySequence>
#include <QObject>
#include <QPointer>
#include <QString>
#include <QWidget>

#include <functional>
#include <map>
#include <optional>
#include <vector>

class QBoxLayout;
class QSplitter;
class QTabWidget;
class QVBoxLayout;

namespace episcope {

class Floating;
class MessageBar;
class Panes;

/// A tab at the right.
struct Tab {
  QString id;  ///< "compare"; its command is "tab.compare".
  QString title;
  QString command_text;  ///< "Compare tab"
  QString command_tip;
  QString icon{};
  QWidget* widget = nullptr;
  QBoxLayout* room = nullptr;  ///< Where other features may add to it; may be null.
  bool waits = false;          ///< It is not among the tabs until it is asked for.
  /// Of its command, empty = none; without it, Ctrl and its number among those without.
  std::optional<QKeySequence> key{};
};

/// Lines under everything else, in their order.
enum class Line { Time, Values };

/// The places of the main window, where features put their widgets: the viewer with a column at its
/// left, tabs at the right, and lines under both.
class Frame : public QWidget {
  Q_OBJECT

 public:
  explicit Frame(QWidget* parent);

  /// Holds the column at the left and the viewer area: keys of KeyScope::Viewer are heard there.
  [[nodiscard]] QWidget* viewer() const { return viewer_; }
  /// In the column at the left; what stretches takes the room that the others leave, below them.
  void addToColumn(QWidget* widget, bool stretches);
  void setViewerArea(QWidget* viewer_area);
  void addTab(const Tab& tab);
  /// Into the room of a tab that has one; else ignored.
  void addToTab(const QString& id, QWidget* widget);
  /// Under the tabs.
  void addUnderTabs(QWidget* widget);
  void addLine(Line line, QWidget* widget);
  /// Over the viewer area: what comes and goes without moving anything.
  void addFloating(QWidget* widget);

  /// The column at the left and the tabs at the right: without them, the viewer area has all the
  /// room.
  void setPanelsShown(bool are_shown);
  [[nodiscard]] bool arePanelsShown() const;

  [[nodiscard]] const std::vector<Tab>& tabs() const { return tabs_; }
  void showTab(const QString& id);
  /// Id of the tab that is shown among the others; empty if all are torn off.
  [[nodiscard]] QString shownTab() const;
  /// What can be in a window of its own: the tabs (by "tab.ID"), and what others add.
  [[nodiscard]] Panes& panes() const { return *panes_; }

  /// The program has begun: features may offer what is left from before.
  void start() { emit started(); }
  /// It was decided what becomes of an earlier session, if one was left.
  void settle() { emit settled(); }
  /// Everything as at first: tells those that moved something themselves.
  void resetLayout() { emit layoutReset(); }
  /// The window is closed, and nothing that the user wants is open any more.
  void end() { emit ended(); }

 signals:
  void started();
  void settled();
  void ended();
  /// Among the others, or in a window of its own.
  void tabShown(const QString& id);
  /// All that can be elsewhere goes back to its first place.
  void layoutReset();

 private:
  void askWhereTabGoes(int index, const QPoint& at);
  void addPane(const Tab& tab);
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
  Panes* panes_;
};

/// Widgets that float at the top of an area, under the captions there and below each other, each as
/// high as it needs to be: nothing moves when they come and go.
class Floating : public QObject {
  Q_OBJECT

 public:
  /// `parent` is that of the widgets; it outlives this.
  explicit Floating(QWidget& parent);

  /// They float over this descendant of the parent; over the parent until it is set.
  void setArea(QWidget* area);
  /// Adds one below those that are there, and makes it a child of the parent.
  void add(QWidget* widget);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place();

  QWidget& parent_;
  QPointer<QWidget> area_;
  std::vector<QPointer<QWidget>> widgets_;
};

/// Messages for the user, floating over the view, that block nothing.
class Messages : public QObject {
  Q_OBJECT

 public:
  explicit Messages(Frame& frame);

  /// No failure: something to do first.
  void hint(const QString& sentence);
  void success(const QString& sentence);
  void warn(const QString& sentence);
  void fail(const QString& sentence);
  /// "Written: …".
  void written(const QString& path);
  /// What was done, with a button that does something about it.
  void offer(const QString& sentence, const QString& button, std::function<void()> run);
  void dismiss();
  [[nodiscard]] bool isShown(const QString& sentence) const;
  /// Takes a sentence back that no longer holds, if it is still what is shown.
  void retract(const QString& sentence);

 private:
  MessageBar* bar_;
};

}  // namespace episcope
