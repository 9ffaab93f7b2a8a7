// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/tool_button.h"

#include "widgets/icon.h"

#include <QToolButton>

namespace episcope {

QToolButton* make_tool_button(const ToolButtonText& text, QWidget* parent) {
  auto* button = new QToolButton(parent);
  button->setObjectName(text.name);
  button->setIcon(themed_icon(text.icon));
  button->setIconSize({14, 14});
  button->setAutoRaise(true);
  button->setToolTip(text.tip);
  if (!text.text.isEmpty()) {
    button->setText(text.text);
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  }
  return button;
}

}  // namespace episcope
