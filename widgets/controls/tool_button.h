// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"

#include <QIcon>
#include <QIconEngine>
#include <QPalette>
#include <QString>

class QAction;
class QBoxLayout;
class QToolButton;
class QWidget;

namespace episcope {

/// Icon of resources/icons by name ("open", "play", …) in the text color of the current palette,
/// so that it follows light and dark themes. Null for an unknown name.
[[nodiscard]] QIcon themed_icon(const QString& name);

/// The program's icon, for its windows.
[[nodiscard]] QIcon program_icon();

/// An icon painted once for each size. Qt's own engine leaves the background of a pixmap undefined;
/// here it is transparent.
class PaintedIconEngine : public QIconEngine {
 public:
  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) final;

 protected:
  /// Key that distinguishes this picture from all other icons, including colors.
  [[nodiscard]] virtual QString look(QIcon::Mode mode) const = 0;
};

/// Side of a swatch, logical pixels.
inline constexpr int kSwatchSize = 16;

/// A label's color as an icon, unchanged in selected rows.
[[nodiscard]] QIcon swatch(const Rgb& rgb, const QPalette& palette);

struct ToolButtonText {
  QString name;      ///< Object name.
  const char* icon;  ///< Of `themed_icon`.
  QString tip;
  QString text = {};  ///< Beside the icon; empty = icon alone.
};

/// A flat tool button in the common style.
[[nodiscard]] QToolButton* make_tool_button(const ToolButtonText& text, QWidget* parent);

/// A flat tool button of an action, "button.ID", with its icon, tip and state; takes no focus.
[[nodiscard]] QToolButton* make_action_button(QAction* action, QWidget* parent);

/// Adds such a button before the last item of a row, which is in place already.
void add_action_button(QBoxLayout* row, QAction* action);

/// Keeps a widget's tool tip equal to its command's, including keys.
void follow_tip(QWidget* widget, const QAction* action);

}  // namespace episcope
