// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/menus.h"

#include <QCoreApplication>

#include <algorithm>

namespace episcope {
namespace {

constexpr const char* kContext = "episcope::Menu";

constexpr MenuInfo kMenus[] = {
    {Menu::File, QT_TRANSLATE_NOOP("episcope::Menu", "File")},
    {Menu::View, QT_TRANSLATE_NOOP("episcope::Menu", "View")},
    {Menu::Views, QT_TRANSLATE_NOOP("episcope::Menu", "Other views"), true, Menu::View},
    {Menu::Measurements, QT_TRANSLATE_NOOP("episcope::Menu", "Measurements"), true, Menu::View},
    {Menu::Tabs, QT_TRANSLATE_NOOP("episcope::Menu", "Tabs"), true, Menu::View},
    {Menu::Panes, QT_TRANSLATE_NOOP("episcope::Menu", "Panes"), true, Menu::View},
    {Menu::Colours, QT_TRANSLATE_NOOP("episcope::Menu", "Colours"), true, Menu::View},
    {Menu::Language, QT_TRANSLATE_NOOP("episcope::Menu", "Language"), true, Menu::View},
    {Menu::Estimate, QT_TRANSLATE_NOOP("episcope::Menu", "Estimate")},
    {Menu::Compare, QT_TRANSLATE_NOOP("episcope::Menu", "Compare")},
    {Menu::Annotate, QT_TRANSLATE_NOOP("episcope::Menu", "Annotate")},
    {Menu::Label, QT_TRANSLATE_NOOP("episcope::Menu", "Label"), true, Menu::Annotate},
    {Menu::Segmentation, QT_TRANSLATE_NOOP("episcope::Menu", "Segmentation"), true, Menu::Annotate},
    {Menu::Help, QT_TRANSLATE_NOOP("episcope::Menu", "Help")}};

const MenuInfo& info_of(Menu menu) {
  return *std::ranges::find(kMenus, menu, &MenuInfo::menu);
}

}  // namespace

std::span<const MenuInfo> menus() {
  return kMenus;
}

QString menu_text(Menu menu) {
  return QCoreApplication::translate(kContext, info_of(menu).text);
}

QString menu_path(Menu menu) {
  const MenuInfo& info = info_of(menu);
  if (!info.is_submenu) return menu_text(menu);
  return QStringLiteral("%1 › %2").arg(menu_path(info.parent), menu_text(menu));
}

}  // namespace episcope
