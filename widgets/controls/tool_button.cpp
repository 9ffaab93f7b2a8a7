// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/tool_button.h"

#include "widgets/style/icon.h"

#include <QAction>
#include <QToolButton>

namespace episcope {

QToolButton* make_tool_button(const ToolButtonText& text, QWidget* parent) {
  auto* button = new QToolButton(parent);
  button->setObjectName(text.name);
  button->setIcon(themed_icon(text.icon));
  button->setIconSize({14, 14});
  button->setAutoRaise(true);
  button->setToolTip(text.tip);
  if (text.text.isEmpty()) {
    button->setAccessibleName(text.tip);
  } else {
    button->setText(text.text);
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  }
  return button;
}

QToolButton* make_action_button(QAction* action, const QString& object_name, QWidget* parent) {
  auto* button = new QToolButton(parent);
  button->setObjectName(object_name);
  button->setDefaultAction(action);
  button->setIconSize({16, 16});
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::NoFocus);
  return button;
}

void follow_tip(QWidget* widget, const QAction* action) {
  const auto follow = [widget, action] { widget->setToolTip(action->toolTip()); };
  QObject::connect(action, &QAction::changed, widget, follow);
  follow();
}

}  // namespace episcope
