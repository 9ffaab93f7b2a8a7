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
enum class KeyScope { Window, Viewer };

/// One command: all that menus, tool bars, tool tips, the list of keys and the palette show of it.
struct Command {
  QString id;  ///< "view.next_column"
  QString menu;
  QString text;  ///< As in the menu, without mnemonic.
  QString tip;   ///< A sentence on what it does.
  QString icon;  ///< Of resources/icons; may be empty.
  QList<QKeySequence> keys;
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

  /// The action with text, tool tip, icon, keys and handler. Its object name is the id.
  QAction* add(const Command& command);
  /// Null for an unknown id.
  [[nodiscard]] QAction* find(const QString& id) const;
  [[nodiscard]] const std::vector<Command>& commands() const { return commands_; }
  /// Fills a menu bar with the menus named by the commands, in order of appearance.
  void fillMenus(QMenuBar& bar) const;

 private:
  QWidget* window_;
  QWidget* viewer_;
  std::vector<Command> commands_;
  std::map<QString, QAction*> actions_;
};

}  // namespace episcope
