// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/action_table.h"

#include "widgets/icon.h"

#include <QAction>
#include <QMenu>
#include <QMenuBar>
#include <QWidget>

namespace episcope {
namespace {

QString tool_tip(const Command& command) {
  if (command.keys.isEmpty()) return command.tip;
  return QStringLiteral("%1 (%2)").arg(command.tip,
                                       command.keys.front().toString(QKeySequence::NativeText));
}

}  // namespace

ActionTable::ActionTable(QWidget* window, QWidget* viewer)
    : QObject(window), window_(window), viewer_(viewer) {}

QAction* ActionTable::add(const Command& command) {
  auto* action = new QAction(command.text, this);
  action->setObjectName(command.id);
  action->setToolTip(tool_tip(command));
  action->setStatusTip(command.tip);
  action->setShortcuts(command.keys);
  action->setCheckable(command.is_checkable);
  if (!command.icon.isEmpty()) action->setIcon(themed_icon(command.icon));
  const bool is_viewer = command.scope == KeyScope::Viewer;
  action->setShortcutContext(is_viewer ? Qt::WidgetWithChildrenShortcut : Qt::WindowShortcut);
  (is_viewer ? viewer_ : window_)->addAction(action);
  if (command.run) connect(action, &QAction::triggered, this, [run = command.run] { run(); });
  commands_.push_back(command);
  actions_[command.id] = action;
  return action;
}

QAction* ActionTable::find(const QString& id) const {
  const auto found = actions_.find(id);
  return found == actions_.end() ? nullptr : found->second;
}

void ActionTable::fillMenus(QMenuBar& bar) const {
  std::map<QString, QMenu*> menus;
  for (const Command& command : commands_) {
    QMenu*& menu = menus[command.menu];
    if (!menu) {
      menu = bar.addMenu(command.menu);
      menu->setObjectName("menu." + command.menu);
      menu->setToolTipsVisible(true);
    }
    if (command.begins_group) menu->addSeparator();
    menu->addAction(find(command.id));
  }
}

}  // namespace episcope
