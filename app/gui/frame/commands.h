// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/frame/menus.h"

#include <QKeySequence>
#include <QList>
#include <QObject>
#include <QString>

#include <functional>
#include <map>
#include <vector>

class QAction;
class QKeyEvent;
class QMenu;
class QMenuBar;
class QToolBar;
class QWidget;

namespace episcope {

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

}  // namespace episcope
