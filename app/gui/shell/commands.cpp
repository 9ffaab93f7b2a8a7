// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/commands.h"

#include "widgets/controls/tool_button.h"

#include <QAction>
#include <QActionGroup>
#include <QCoreApplication>
#include <QEvent>
#include <QKeyEvent>
#include <QMenu>
#include <QMenuBar>
#include <QSettings>
#include <QToolBar>
#include <QToolButton>
#include <QWidget>

#include <algorithm>
#include <iterator>
#include <optional>

namespace episcope {
namespace {

QString settings_key(const QString& id) {
  return "keys/" + id;
}

// Keys that the user gave a command; none if it has its defaults.
std::optional<QList<QKeySequence>> remembered_keys(const QString& id) {
  const QSettings settings;
  if (!settings.contains(settings_key(id))) return std::nullopt;
  QList<QKeySequence> keys;
  for (const QString& key : settings.value(settings_key(id)).toStringList()) {
    keys << QKeySequence(key, QKeySequence::PortableText);
  }
  return keys;
}

// Underlines the first letter that no title before has, in whatever language.
QString with_mnemonic(QString title, QString& used) {
  for (qsizetype i = 0; i < title.size(); ++i) {
    const QChar key = title[i].toLower();
    if (!key.isLetter() || used.contains(key)) continue;
    used += key;
    return title.insert(i, '&');
  }
  return title;
}

}  // namespace

Commands::Commands(QWidget* window, QWidget* viewer)
    : QObject(window), window_(window), viewer_(viewer) {}

QAction* Commands::add(Command command) {
  QAction* action = command.submenu ? command.submenu->menuAction() : new QAction(this);
  action->setObjectName(command.id);
  action->setText(command.text);
  action->setStatusTip(command.tip);
  action->setCheckable(static_cast<bool>(command.checked));
  if (!command.choice.isEmpty()) {
    QActionGroup*& group = choices_[command.choice];
    if (!group) group = new QActionGroup(this);
    group->setExclusionPolicy(QActionGroup::ExclusionPolicy::ExclusiveOptional);
    group->addAction(action);
    action->setIconVisibleInMenu(false);  // It would stand in the place of the mark.
  }
  if (!command.icon.isEmpty()) action->setIcon(themed_icon(command.icon));
  const bool is_viewer = command.scope == KeyScope::Viewer;
  action->setShortcutContext(is_viewer ? Qt::WidgetWithChildrenShortcut : Qt::WindowShortcut);
  (is_viewer ? viewer_ : window_)->addAction(action);
  if (command.run) {
    connect(action, &QAction::triggered, this, [this, run = command.run] {
      run();
      refresh();  // A click has checked the action, whatever came of it.
    });
  }
  const QString id = command.id;
  commands_.push_back(std::move(command));
  actions_[id] = action;
  apply(commands_.back(), remembered_keys(id).value_or(commands_.back().keys));
  return action;
}

void Commands::add(const Command& common, std::vector<Command> commands) {
  for (Command& each : commands) {
    each.menu = common.menu;
    each.section = common.section;
    if (!each.enabled) each.enabled = common.enabled;
    add(std::move(each));
  }
}

void Commands::apply(const Command& command, const QList<QKeySequence>& keys) {
  keys_[command.id] = keys;
  QAction* action = find(command.id);
  if (command.scope != KeyScope::Held) action->setShortcuts(keys);
  action->setToolTip(keys.isEmpty()
                         ? command.tip
                         : QStringLiteral("%1 (%2)").arg(command.tip, keyText(command.id)));
}

void Commands::show(const Command& command) {
  QAction* action = find(command.id);
  if (command.enabled) action->setEnabled(command.enabled());
  if (command.checked) action->setChecked(command.checked());
  if (command.visible) action->setVisible(command.visible());
  if (command.live_text) action->setText(command.live_text());
}

QAction* Commands::find(const QString& id) const {
  const auto found = actions_.find(id);
  return found == actions_.end() ? nullptr : found->second;
}

void Commands::addTargets(std::function<std::vector<PaletteTarget>()> list) {
  targets_.push_back(std::move(list));
}

std::vector<PaletteTarget> Commands::targets() const {
  std::vector<PaletteTarget> all;
  for (const auto& list : targets_) std::ranges::move(list(), std::back_inserter(all));
  return all;
}

bool Commands::trigger(const QString& id) {
  QAction* action = find(id);
  if (!action || !action->isEnabled()) return false;
  action->trigger();
  return true;
}

const Command* Commands::command(const QString& id) const {
  const auto found = std::ranges::find(commands_, id, &Command::id);
  return found == commands_.end() ? nullptr : &*found;
}

QList<QKeySequence> Commands::keys(const QString& id) const {
  const auto found = keys_.find(id);
  return found == keys_.end() ? QList<QKeySequence>() : found->second;
}

QString Commands::keyText(const QString& id) const {
  const QList<QKeySequence> known = keys(id);
  return known.isEmpty() ? QString() : known.front().toString(QKeySequence::NativeText);
}

bool Commands::hasOwnKeys(const QString& id) const {
  const Command* found = command(id);
  return found && keys(id) != found->keys;
}

QString Commands::userOf(const QKeySequence& key) const {
  for (const auto& [id, keys] : keys_) {
    if (keys.contains(key)) return id;
  }
  return {};
}

void Commands::setKeys(const QString& id, const QList<QKeySequence>& keys) {
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

void Commands::resetKeys(const QString& id) {
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

void Commands::resetAllKeys() {
  QSettings().remove("keys");
  for (const Command& each : commands_) apply(each, each.keys);
  emit keysChanged();
}

void Commands::hearViewerKeys(QWidget* widget) const {
  for (const Command& each : commands_) {
    if (each.scope == KeyScope::Viewer) widget->addAction(find(each.id));
  }
}

void Commands::hearHeldKeys(QWidget* widget) {
  widget->installEventFilter(this);
}

bool Commands::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::KeyPress || event->type() == QEvent::KeyRelease) {
    const auto& key = *static_cast<QKeyEvent*>(event);
    for (const Command& each : commands_) {
      if (each.scope == KeyScope::Held && hearHeld(each, key)) return true;
    }
  } else if (event->type() == QEvent::FocusOut && !held_.isEmpty()) {
    command(std::exchange(held_, {}))->hold(false);
  }
  return QObject::eventFilter(watched, event);
}

bool Commands::hearHeld(const Command& command, const QKeyEvent& event) {
  const bool is_press = event.type() == QEvent::KeyPress;
  for (const QKeySequence& key : keys(command.id)) {
    // Modifiers may be let go before the key.
    const bool is_heard = is_press ? QKeySequence(event.keyCombination()) == key
                                   : event.key() == key[0].key() && held_ == command.id;
    if (!is_heard) continue;
    if (event.isAutoRepeat() || !find(command.id)->isEnabled()) return true;
    held_ = is_press ? command.id : QString();
    command.hold(is_press);
    return true;
  }
  return false;
}

void Commands::fillMenus(QMenuBar& bar) const {
  std::map<Menu, QMenu*> made;
  QString used;
  for (const MenuInfo& info : menus()) {
    QMenu* menu = info.is_submenu ? new QMenu(menu_text(info.menu), made.at(info.parent))
                                  : bar.addMenu(with_mnemonic(menu_text(info.menu), used));
    menu->setObjectName("menu." + menu_path(info.menu));
    menu->setToolTipsVisible(true);
    made[info.menu] = menu;
  }
  // Submenus first: an empty one has no entry.
  const std::span<const MenuInfo> all = menus();
  for (auto info = all.rbegin(); info != all.rend(); ++info) fillMenu(info->menu, made);
}

void Commands::fillMenu(Menu which, const std::map<Menu, QMenu*>& made) const {
  std::vector<std::pair<int, QAction*>> entries;
  for (const Command& each : commands_) {
    if (each.menu == which) entries.emplace_back(each.section, find(each.id));
  }
  for (const MenuInfo& info : menus()) {
    if (!info.is_submenu || info.parent != which || made.at(info.menu)->isEmpty()) continue;
    entries.emplace_back(info.section, made.at(info.menu)->menuAction());
  }
  std::ranges::stable_sort(entries, {}, &std::pair<int, QAction*>::first);
  QMenu& menu = *made.at(which);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i > 0 && entries[i].first != entries[i - 1].first) menu.addSeparator();
    menu.addAction(entries[i].second);
  }
}

void Commands::addBarWidget(BarSection section, QWidget* widget) {
  bar_widgets_.emplace_back(section, widget);
}

void Commands::fillBar(QToolBar& bar) const {
  for (const BarSection section :
       {BarSection::Files, BarSection::Compare, BarSection::Look, BarSection::Help}) {
    const auto before = bar.actions().size();
    QAction* separator = before == 0 ? nullptr : bar.addSeparator();
    for (const auto& [place, widget] : bar_widgets_) {
      if (place == section) bar.addWidget(widget);
    }
    for (const Command& each : commands_) {
      if (each.bar == section) bar.addAction(find(each.id));
    }
    if (separator && bar.actions().size() == before + 1) bar.removeAction(separator);
  }
  for (auto* button : bar.findChildren<QToolButton*>()) button->setFocusPolicy(Qt::NoFocus);
}

namespace {

constexpr const char* kMenuContext = "episcope::Menu";

constexpr MenuInfo kMenus[] = {
    {Menu::File, QT_TRANSLATE_NOOP("episcope::Menu", "File")},
    {Menu::Open, QT_TRANSLATE_NOOP("episcope::Menu", "Open"), true, Menu::File, section::kFiles},
    {Menu::Project, QT_TRANSLATE_NOOP("episcope::Menu", "Project"), true, Menu::File,
     section::kFiles},
    {Menu::Export, QT_TRANSLATE_NOOP("episcope::Menu", "Export"), true, Menu::File,
     section::kFiles},
    {Menu::View, QT_TRANSLATE_NOOP("episcope::Menu", "View")},
    {Menu::Map, QT_TRANSLATE_NOOP("episcope::Menu", "Map"), true, Menu::View, section::kMap},
    {Menu::Views, QT_TRANSLATE_NOOP("episcope::Menu", "Other views"), true, Menu::View,
     section::kMore},
    {Menu::Measurements, QT_TRANSLATE_NOOP("episcope::Menu", "Measurements"), true, Menu::View,
     section::kMore},
    {Menu::Tabs, QT_TRANSLATE_NOOP("episcope::Menu", "Tabs"), true, Menu::View, section::kMore},
    {Menu::Panes, QT_TRANSLATE_NOOP("episcope::Menu", "Panes"), true, Menu::View, section::kMore},
    {Menu::Colors, QT_TRANSLATE_NOOP("episcope::Menu", "Theme"), true, Menu::View, section::kMore},
    {Menu::Language, QT_TRANSLATE_NOOP("episcope::Menu", "Language"), true, Menu::View,
     section::kMore},
    {Menu::Estimate, QT_TRANSLATE_NOOP("episcope::Menu", "Estimate")},
    {Menu::Compare, QT_TRANSLATE_NOOP("episcope::Menu", "Compare")},
    {Menu::Annotate, QT_TRANSLATE_NOOP("episcope::Menu", "Annotate")},
    {Menu::Labels, QT_TRANSLATE_NOOP("episcope::Menu", "Labels"), true, Menu::Annotate,
     section::kMore},
    {Menu::Segmentation, QT_TRANSLATE_NOOP("episcope::Menu", "Segmentation"), true, Menu::Annotate,
     section::kMore},
    {Menu::Help, QT_TRANSLATE_NOOP("episcope::Menu", "Help")}};

const MenuInfo& info_of(Menu menu) {
  return *std::ranges::find(kMenus, menu, &MenuInfo::menu);
}

}  // namespace

std::span<const MenuInfo> menus() {
  return kMenus;
}

QString menu_text(Menu menu) {
  return QCoreApplication::translate(kMenuContext, info_of(menu).text);
}

QString menu_path(Menu menu) {
  const MenuInfo& info = info_of(menu);
  if (!info.is_submenu) return menu_text(menu);
  return QStringLiteral("%1 › %2").arg(menu_path(info.parent), menu_text(menu));
}

}  // namespace episcope

#include "moc_commands.cpp"
