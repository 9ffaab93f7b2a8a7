// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QKeySequence>
#include <QList>
#include <QObject>
#include <QString>

#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

class QAction;
class QKeyEvent;
class QMenu;
class QMenuBar;
class QToolBar;
class QWidget;

namespace episcope {

/// Menus of the window, in their order.
enum class Menu {
  File,
  View,
  Views,  ///< In View, as all up to Language.
  Measurements,
  Tabs,
  Panes,
  Colours,
  Language,
  Estimate,
  Compare,
  Annotate,
  Label,         ///< In Annotate,
  Segmentation,  ///< as is this one.
  Help
};

/// One row of the table of menus.
struct MenuInfo {
  Menu menu;
  const char* text;  ///< Untranslated.
  bool is_submenu = false;
  Menu parent = Menu::File;  ///< Of a submenu.
};

/// Every menu; a submenu stands after its parent.
[[nodiscard]] std::span<const MenuInfo> menus();

/// "View", or "View › Colours" for a submenu, translated.
[[nodiscard]] QString menu_path(Menu menu);
/// "Colours", translated.
[[nodiscard]] QString menu_text(Menu menu);

/// Sections of menus that several features fill. Within a menu, sections stand in the order of
/// their numbers with lines between them; within a section, commands stand in the order in which
/// they were added. Submenus come last.
namespace section {

inline constexpr int kOpen = 0;       ///< File
inline constexpr int kProject = 1;    ///< File
inline constexpr int kScribbles = 2;  ///< File
inline constexpr int kExport = 3;     ///< File
inline constexpr int kLeave = 4;      ///< File

inline constexpr int kWalk = 0;    ///< Views
inline constexpr int kFrames = 1;  ///< Views
inline constexpr int kZoom = 0;    ///< View
inline constexpr int kFocus = 1;   ///< View
inline constexpr int kTabs = 2;    ///< View

}  // namespace section

/// Sections of the tool bar, in their order.
enum class BarSection { None, Files, Maps, Compare, Look, Help };

/// Where the keys of a command are heard.
enum class KeyScope {
  Window,
  Viewer,
  Held  ///< In the widgets given to `Commands::hearHeldKeys`: `hold` is told of press and release.
};

/// One command: all that menus, tool bars, tool tips, the list of keys and the palette show of it,
/// what it does and when it can be run.
struct Command {
  QString id;  ///< "view.left"
  Menu menu = Menu::File;
  QString text;                ///< As in the menu, without mnemonic.
  QString tip;                 ///< A sentence on what it does.
  QString icon{};              ///< Of resources/icons; may be empty.
  QList<QKeySequence> keys{};  ///< Until the user gives it others.
  std::function<void()> run{};
  int section = 0;  ///< Of the menu, see `section`.
  BarSection bar = BarSection::None;
  KeyScope scope = KeyScope::Window;
  std::function<bool()> enabled{};       ///< Empty = always.
  std::function<bool()> checked{};       ///< Makes it checkable.
  std::function<bool()> visible{};       ///< Empty = always.
  std::function<QString()> live_text{};  ///< Its text as things are now; empty = `text`.
  std::function<void(bool)> hold{};      ///< For KeyScope::Held.
  QMenu* submenu = nullptr;              ///< Opened by the entry, which then runs nothing.
};

/// The one table of commands, in the order in which they were added. Whoever changes what
/// `enabled`, `checked`, `visible` or `live_text` depend on calls `refresh`.
class Commands : public QObject {
  Q_OBJECT

 public:
  /// `window` hears the keys of scope Window, `viewer` those of scope Viewer.
  Commands(QWidget* window, QWidget* viewer);

  /// The action with text, tool tip, icon, keys (the user's, if changed) and handler. Its object
  /// name is the id.
  QAction* add(Command command);
  /// Null for an unknown id.
  [[nodiscard]] QAction* find(const QString& id) const;
  [[nodiscard]] const std::vector<Command>& all() const { return commands_; }
  /// Runs a command if it is enabled. Returns whether it was.
  bool trigger(const QString& id);

  /// The current keys of a command: its defaults unless the user changed them.
  [[nodiscard]] QList<QKeySequence> keys(const QString& id) const;
  /// The first of them as it is written; empty if there is none.
  [[nodiscard]] QString keyText(const QString& id) const;
  /// Whether the user changed the keys of the command.
  [[nodiscard]] bool hasOwnKeys(const QString& id) const;
  /// Id of the command that a key belongs to; empty if it is free.
  [[nodiscard]] QString userOf(const QKeySequence& key) const;
  /// Changes keys and stores them in the settings. Another command that has them keeps them: check
  /// first.
  void setKeys(const QString& id, const QList<QKeySequence>& keys);
  /// Restores the default keys, except those that another command has now.
  void resetKeys(const QString& id);
  void resetAllKeys();
  /// Keys of scope Viewer are heard in this widget as well.
  void hearViewerKeys(QWidget* widget) const;
  /// Keys of scope Held are heard in this widget, which must outlive this.
  void hearHeldKeys(QWidget* widget);

  /// Fills a menu bar, once all commands are there.
  void fillMenus(QMenuBar& bar) const;
  /// A widget in the tool bar, before the commands of its section.
  void addBarWidget(BarSection section, QWidget* widget);
  /// Likewise a tool bar.
  void fillBar(QToolBar& bar) const;

 public slots:
  /// Enables, checks, shows and names all commands as things are now.
  void refresh();

 signals:
  void keysChanged();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  [[nodiscard]] const Command* command(const QString& id) const;
  void apply(const Command& command, const QList<QKeySequence>& keys);
  void show(const Command& command);
  void fillMenu(QMenu& menu, Menu which) const;
  /// Whether a key event belongs to a held command, which is then told.
  bool hearHeld(const Command& command, const QKeyEvent& event);

  QWidget* window_;
  QWidget* viewer_;
  std::vector<Command> commands_;
  std::map<QString, QAction*> actions_;
  std::map<QString, QList<QKeySequence>> keys_;
  std::vector<std::pair<BarSection, QWidget*>> bar_widgets_;
  QString held_;  // id of the command whose key is down
};

/// What the cancel key can end, in the order in which it is tried.
enum class CancelRank {
  Stroke,
  LiveSegmentation,
  Browsing,  ///< Playing, a line drawn in an EPI.
  Comparing,
  Mark,  ///< What is outlined on the view.
  Job,
  Message
};

/// What can be cancelled, by rank: the cancel key ends the first that is active.
class Cancels {
 public:
  /// `cancel` returns whether there was something to end.
  void add(CancelRank rank, std::function<bool()> cancel) {
    cancels_.emplace(rank, std::move(cancel));
  }

  /// Returns whether anything was ended.
  bool cancel() const {
    for (const auto& [rank, cancel] : cancels_) {
      if (cancel()) return true;
    }
    return false;
  }

 private:
  std::multimap<CancelRank, std::function<bool()>> cancels_;
};

/// What is about to be left.
enum class Leaving {
  Scene,    ///< The light field that is shown is closed, or read in another way.
  Reading,  ///< It is read in another way, and its results are brought back.
  Session   ///< All that is open.
};

/// Keeps what is open from being closed while something would be lost.
class LeaveGuards {
 public:
  using Continue = std::function<void()>;

  struct Guard {
    std::function<bool(Leaving)> may_leave;  ///< Whether nothing would be lost now.
    /// Asks the user and calls back once nothing is lost any more, or never.
    std::function<void(Leaving, Continue)> ask;
  };

  void add(Guard guard) { guards_.push_back(std::move(guard)); }

  [[nodiscard]] bool may_leave(Leaving what) const {
    for (const Guard& each : guards_) {
      if (!each.may_leave(what)) return false;
    }
    return true;
  }

  /// Calls `go_on` once every guard agrees: at once if nothing would be lost, or never.
  void leave(Leaving what, const Continue& go_on) const { ask(0, what, go_on); }

 private:
  void ask(std::size_t first, Leaving what, const Continue& go_on) const {
    if (first == guards_.size()) {
      go_on();
    } else {
      guards_[first].ask(what, [this, first, what, go_on] { ask(first + 1, what, go_on); });
    }
  }

  std::vector<Guard> guards_;
};

}  // namespace episcope
