// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>

#include <span>

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

}  // namespace episcope
