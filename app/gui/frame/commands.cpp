// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/commands.h"

#include "widgets/style/icon.h"

#include <QAction>
#include <QMenu>
#include <QMenuBar>
#include <QSettings>
#include <QWidget>

#include <algorithm>

namespace episcope {
namespace {

const QString kSubmenu = QStringLiteral(" › ");

QString settings_key(const QString& id) {
  return "keys/" + id;
}

}  // namespace

ActionTable::ActionTable(QWidget* window, QWidget* viewer)
    : QObject(window), window_(window), viewer_(viewer) {}

QAction* ActionTable::add(const Command& command) {
  auto* action = new QAction(command.text, this);
  action->setObjectName(command.id);
  action->setStatusTip(command.tip);
  action->setCheckable(command.is_checkable);
  if (!command.icon.isEmpty()) action->setIcon(themed_icon(command.icon));
  const bool is_viewer = command.scope == KeyScope::Viewer;
  action->setShortcutContext(is_viewer ? Qt::WidgetWithChildrenShortcut : Qt::WindowShortcut);
  (is_viewer ? viewer_ : window_)->addAction(action);
  if (command.run) connect(action, &QAction::triggered, this, [run = command.run] { run(); });
  commands_.push_back(command);
  actions_[command.id] = action;
  const QSettings settings;
  QList<QKeySequence> keys = command.keys;
  if (settings.contains(settings_key(command.id))) {
    keys.clear();
    for (const QString& key : settings.value(settings_key(command.id)).toStringList()) {
      keys << QKeySequence(key, QKeySequence::PortableText);
    }
  }
  apply(command, keys);
  return action;
}

void ActionTable::apply(const Command& command, const QList<QKeySequence>& keys) {
  keys_[command.id] = keys;
  QAction* action = find(command.id);
  // Of a held key, press and release are heard by who needs them.
  if (command.scope != KeyScope::Held) action->setShortcuts(keys);
  action->setToolTip(keys.isEmpty()
                         ? command.tip
                         : QStringLiteral("%1 (%2)").arg(command.tip, keyText(command.id)));
}

QAction* ActionTable::find(const QString& id) const {
  const auto found = actions_.find(id);
  return found == actions_.end() ? nullptr : found->second;
}

const Command* ActionTable::command(const QString& id) const {
  const auto found = std::find_if(commands_.begin(), commands_.end(),
                                  [&](const Command& each) { return each.id == id; });
  return found == commands_.end() ? nullptr : &*found;
}

QList<QKeySequence> ActionTable::keys(const QString& id) const {
  const auto found = keys_.find(id);
  return found == keys_.end() ? QList<QKeySequence>() : found->second;
}

QString ActionTable::keyText(const QString& id) const {
  const QList<QKeySequence> known = keys(id);
  return known.isEmpty() ? QString() : known.front().toString(QKeySequence::NativeText);
}

bool ActionTable::hasOwnKeys(const QString& id) const {
  const Command* found = command(id);
  return found && keys(id) != found->keys;
}

QString ActionTable::userOf(const QKeySequence& key) const {
  for (const auto& [id, keys] : keys_) {
    if (keys.contains(key)) return id;
  }
  return {};
}

void ActionTable::setKeys(const QString& id, const QList<QKeySequence>& keys) {
  const Command* found = command(id);
  if (!found) return;
  QStringList texts;
  for (const QKeySequence& key : keys) texts << key.toString(QKeySequence::PortableText);
  if (keys == found->keys) {
    QSettings().remove(settings_key(id));
  } else {
    QSettings().setValue(settings_key(id), texts);
  }
  apply(*found, keys);
  emit keysChanged();
}

void ActionTable::resetKeys(const QString& id) {
  const Command* found = command(id);
  if (!found) return;
  // Keys that another command was given meanwhile stay with it.
  QList<QKeySequence> free;
  for (const QKeySequence& key : found->keys) {
    const QString user = userOf(key);
    if (user.isEmpty() || user == id) free << key;
  }
  setKeys(id, free);
}

void ActionTable::resetAllKeys() {
  QSettings().remove("keys");
  for (const Command& each : commands_) apply(each, each.keys);
  emit keysChanged();
}

void ActionTable::fillMenus(QMenuBar& bar) const {
  std::map<QString, QMenu*> menus;
  for (const Command& command : commands_) {
    QMenu*& menu = menus[command.menu];
    if (!menu) {
      const qsizetype split = command.menu.indexOf(kSubmenu);
      QMenu* above = split < 0 ? nullptr : menus[command.menu.left(split)];
      menu = above ? above->addMenu(command.menu.mid(split + kSubmenu.size()))
                   : bar.addMenu('&' + command.menu);  // all begin differently
      menu->setObjectName("menu." + command.menu);
      menu->setToolTipsVisible(true);
    }
    if (command.begins_group) menu->addSeparator();
    menu->addAction(find(command.id));
  }
}

}  // namespace episcope
