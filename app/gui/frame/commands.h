// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QKeySequence>
#include <QList>
#include <QObject>
#include <QString>

#include <functional>
#include <map>
#include <vector>

class QAction;
class QMenuBar;

namespace episcope {

/// Where the keys of a command are heard.
enum class KeyScope {
  Window,
  Viewer,
  Held  ///< Nowhere: who needs press and release asks `ActionTable::keys`.
};

/// One command: all that menus, tool bars, tool tips, the list of keys and the palette show of it.
struct Command {
  QString id;    ///< "view.next_column"
  QString menu;  ///< "View"; "View › Zoom" for a menu in a menu that has commands already.
  QString text;  ///< As in the menu, without mnemonic.
  QString tip;   ///< A sentence on what it does.
  QString icon;  ///< Of resources/icons; may be empty.
  QList<QKeySequence> keys;   ///< Until the user gives it others.
  std::function<void()> run;  ///< May be empty: whoever needs it listens to the action.
  KeyScope scope = KeyScope::Window;
  bool is_checkable = false;
  bool begins_group = false;  ///< A separator stands before it in the menu.
};

/// The one table of commands, in the order of menus.
class ActionTable : public QObject {
  Q_OBJECT

 public:
  /// `window` hears the keys of scope Window, `viewer` those of scope Viewer.
  ActionTable(QWidget* window, QWidget* viewer);

  /// The action with text, tool tip, icon, keys (those of the user, if there are) and handler. Its
  /// object name is the id.
  QAction* add(const Command& command);
  /// Null for an unknown id.
  [[nodiscard]] QAction* find(const QString& id) const;
  [[nodiscard]] const std::vector<Command>& commands() const { return commands_; }

  /// Keys of a command now; its own ones unless the user changed them.
  [[nodiscard]] QList<QKeySequence> keys(const QString& id) const;
  /// The first of them as it is written; empty if there is none.
  [[nodiscard]] QString keyText(const QString& id) const;
  /// Whether the user gave the command other keys than its own.
  [[nodiscard]] bool hasOwnKeys(const QString& id) const;
  /// Id of the command that a key belongs to; empty if it is free.
  [[nodiscard]] QString userOf(const QKeySequence& key) const;
  /// Changes keys and remembers them in the settings. Who has them already keeps them: look first.
  void setKeys(const QString& id, const QList<QKeySequence>& keys);
  /// Back to the command's own keys, but for those that another command has now.
  void resetKeys(const QString& id);
  void resetAllKeys();

  /// Fills a menu bar with the menus named by the commands, in order of appearance.
  void fillMenus(QMenuBar& bar) const;

 signals:
  void keysChanged();

 private:
  [[nodiscard]] const Command* command(const QString& id) const;
  void apply(const Command& command, const QList<QKeySequence>& keys);

  QWidget* window_;
  QWidget* viewer_;
  std::vector<Command> commands_;
  std::map<QString, QAction*> actions_;
  std::map<QString, QList<QKeySequence>> keys_;
};

}  // namespace episcope
