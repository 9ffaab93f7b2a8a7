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
class QActionGroup;
class QKeyEvent;
class QMenu;
class QMenuBar;
class QToolBar;
class QWidget;

namespace episcope {

/// Menus of the window, in their order.
enum class Menu {
  File,
  Open,     ///< Submenu of File,
  Project,  ///< like this one
  Export,   ///< and this one: all that writes files for others.
  View,
  Map,  ///< Submenu of View, like all up to Language.
  Views,
  Measurements,
  Tabs,
  Panes,
  Colors,
  Language,
  Estimate,
  Compare,
  Annotate,
  Labels,        ///< Submenu of Annotate,
  Segmentation,  ///< like this one.
  Help
};

struct MenuInfo {
  Menu menu;
  const char* text;  ///< Untranslated.
  bool is_submenu = false;
  Menu parent = Menu::File;  ///< Only for submenus.
  int section = 0;           ///< Of the parent's menu, only for submenus.
};

/// Every menu; a submenu stands after its parent.
[[nodiscard]] std::span<const MenuInfo> menus();

/// "View", or "View › Colors" for a submenu, translated.
[[nodiscard]] QString menu_path(Menu menu);

/// "Colors", translated.
[[nodiscard]] QString menu_text(Menu menu);

/// Sections of menus that several features fill. A menu shows its sections by number with lines
/// between, commands within a section in order of addition, and then its submenus.
namespace section {

inline constexpr int kFiles = 0;    ///< File: its submenus
inline constexpr int kReading = 1;  ///< File
inline constexpr int kLeave = 2;    ///< File

inline constexpr int kOpen = 0;   ///< Open
inline constexpr int kScene = 1;  ///< Open: of a collection

inline constexpr int kResults = 0;   ///< Export
inline constexpr int kPictures = 1;  ///< Export
inline constexpr int kLabels = 2;    ///< Export
inline constexpr int kField = 3;     ///< Export: the light field itself

inline constexpr int kMaps = 0;     ///< Map
inline constexpr int kMapLook = 1;  ///< Map

inline constexpr int kWalk = 0;    ///< Views
inline constexpr int kFrames = 1;  ///< Views
inline constexpr int kMap = 0;     ///< View: its submenu
inline constexpr int kZoom = 1;    ///< View
inline constexpr int kFocus = 2;   ///< View
inline constexpr int kTabs = 3;    ///< View
inline constexpr int kMore = 9;    ///< View, Annotate: further submenus

}  // namespace section

/// Sections of the tool bar, in their order.
enum class BarSection { None, Files, Compare, Look, Help };

/// Where the keys of a command are heard.
enum class KeyScope {
  Window,
  Viewer,
  Held  ///< In widgets of `Commands::hearHeldKeys`; `hold` is called on press and release.
};

/// One command: its texts and keys in menus, tool bars, tool tips, key list and palette; its
/// action; and its conditions.
struct Command {
  QString id{};  ///< "view.left"
  Menu menu = Menu::File;
  QString text{};              ///< As in the menu, without mnemonic.
  QString tip{};               ///< A sentence: what it does.
  QString icon{};              ///< Name in resources/icons; may be empty.
  QList<QKeySequence> keys{};  ///< Until the user gives it others.
  std::function<void()> run{};
  int section = 0;  ///< Section of the menu, see `section`.
  BarSection bar = BarSection::None;
  KeyScope scope = KeyScope::Window;
  std::function<bool()> enabled{};       ///< Empty = always.
  std::function<bool()> checked{};       ///< Makes it checkable.
  QString choice{};                      ///< Name of the choices of which one at most is checked.
  std::function<bool()> visible{};       ///< Empty = always.
  std::function<QString()> live_text{};  ///< Current text; empty = `text`.
  std::function<void(bool)> hold{};      ///< For KeyScope::Held.
  QMenu* submenu = nullptr;              ///< Opened by the entry, which then runs nothing.
};

/// Something that is found like a command: a method, an open light field.
struct PaletteTarget {
  QString title;
  QString tip;
  QString words{};  ///< Finds it, as the words of title and tip do.
  std::function<void()> run;
};

/// The one table of commands, in order of addition. Call `refresh` after changes that `enabled`,
/// `checked`, `visible` or `live_text` depend on.
class Commands : public QObject {
  Q_OBJECT

 public:
  /// `window` hears keys of scope Window, `viewer` keys of scope Viewer.
  Commands(QWidget* window, QWidget* viewer);

  /// Creates the action with text, tool tip, icon, keys (the user's, if changed) and handler. Its
  /// object name is the id.
  QAction* add(Command command);
  /// Adds commands with the menu and section of `common`, and its condition if they have none.
  void add(const Command& common, std::vector<Command> commands);
  /// Null for an unknown id.
  [[nodiscard]] QAction* find(const QString& id) const;
  [[nodiscard]] const std::vector<Command>& all() const { return commands_; }
  /// Adds a list of what else can be found at the time of asking.
  void addTargets(std::function<std::vector<PaletteTarget>()> list);
  [[nodiscard]] std::vector<PaletteTarget> targets() const;
  /// Runs a command if it is enabled; returns whether it was.
  bool trigger(const QString& id);

  /// Current keys of a command: the user's, else the defaults.
  [[nodiscard]] QList<QKeySequence> keys(const QString& id) const;
  /// First key of a command as text; empty if there is none.
  [[nodiscard]] QString keyText(const QString& id) const;
  /// Whether the user changed the command's keys.
  [[nodiscard]] bool hasOwnKeys(const QString& id) const;
  /// Id of the command that uses a key; empty if it is free.
  [[nodiscard]] QString userOf(const QKeySequence& key) const;
  /// Changes keys and stores them in the settings. Does not take keys from other commands: check
  /// first.
  void setKeys(const QString& id, const QList<QKeySequence>& keys);
  /// Restores the default keys, except keys that another command uses now.
  void resetKeys(const QString& id);
  void resetAllKeys();
  /// Hears keys of scope Viewer in this widget, too.
  void hearViewerKeys(QWidget* widget) const;
  /// Hears keys of scope Held in this widget, which must outlive this.
  void hearHeldKeys(QWidget* widget);

  /// Fills the menu bar, after all commands were added.
  void fillMenus(QMenuBar& bar) const;
  /// Puts a widget into the tool bar, before the commands of its section.
  void addBarWidget(BarSection section, QWidget* widget);
  /// Fills the tool bar, after all commands were added.
  void fillBar(QToolBar& bar) const;

 public slots:
  /// Updates enabled, checked, visible and text of all commands.
  void refresh() {
    for (const Command& each : commands_) show(each);
  }

 signals:
  void keysChanged();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  [[nodiscard]] const Command* command(const QString& id) const;
  void apply(const Command& command, const QList<QKeySequence>& keys);
  void show(const Command& command);
  void fillMenu(Menu which, const std::map<Menu, QMenu*>& made) const;
  /// Whether a key event belongs to a held command, which is notified.
  bool hearHeld(const Command& command, const QKeyEvent& event);

  QWidget* window_;
  QWidget* viewer_;
  std::vector<Command> commands_;
  std::vector<std::function<std::vector<PaletteTarget>()>> targets_;
  std::map<QString, QAction*> actions_;
  std::map<QString, QActionGroup*> choices_;
  std::map<QString, QList<QKeySequence>> keys_;
  std::vector<std::pair<BarSection, QWidget*>> bar_widgets_;
  QString held_;  // id of the command whose key is down
};

/// Things that the cancel key can end, in the order of trial.
enum class CancelRank {
  Stroke,
  LiveSegmentation,
  Browsing,  ///< Playing, a line drawn in an EPI.
  Comparing,
  Mark,  ///< An outline on the view.
  Job,
  Message
};

/// Cancellable activities by rank; the cancel key ends the first active one.
class Cancels {
 public:
  /// `cancel` returns whether it ended something.
  void add(CancelRank rank, std::function<bool()> cancel) {
    cancels_.emplace(rank, std::move(cancel));
  }

  /// Returns whether something was ended.
  bool cancel() const {
    for (const auto& [rank, cancel] : cancels_) {
      if (cancel()) return true;
    }
    return false;
  }

 private:
  std::multimap<CancelRank, std::function<bool()>> cancels_;
};

/// What the user is about to leave.
enum class Leaving {
  Scene,    ///< The light field that is shown is closed, or read in another way.
  Reading,  ///< It is read in another way, and its results are brought back.
  Session   ///< Everything open is closed.
};

/// Keeps open work from being closed while something would be lost.
class LeaveGuards {
 public:
  using Continue = std::function<void()>;

  struct Guard {
    std::function<bool(Leaving)> may_leave;  ///< Whether nothing would be lost now.
    /// Asks the user, and calls back once nothing would be lost, or never.
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
