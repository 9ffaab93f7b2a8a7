// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>

class QAction;
class QToolButton;
class QWidget;

namespace episcope {

struct ToolButtonText {
  QString name;      ///< Object name.
  const char* icon;  ///< Of `themed_icon`.
  QString tip;
  QString text = {};  ///< Beside the icon; empty = icon alone.
};

/// A flat tool button, the same everywhere.
[[nodiscard]] QToolButton* make_tool_button(const ToolButtonText& text, QWidget* parent);

/// A flat tool button of an action, with its icon, tip and state; it takes no focus.
[[nodiscard]] QToolButton* make_action_button(QAction* action, const QString& object_name,
                                              QWidget* parent);

/// Keeps the tool tip of a widget that of the command behind it, with its keys.
void follow_tip(QWidget* widget, const QAction* action);

}  // namespace episcope
