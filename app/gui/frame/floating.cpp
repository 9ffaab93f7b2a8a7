// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/floating.h"

#include "widgets/style/theme.h"

#include <QEvent>

#include <algorithm>

namespace episcope {
namespace {

constexpr int kWidest = 760;  // longer lines are hard to read

int height_of(const QWidget& widget, int width) {
  return widget.hasHeightForWidth() ? widget.heightForWidth(width) : widget.sizeHint().height();
}

}  // namespace

Floating::Floating(QWidget& over) : QObject(&over), over_(over) {
  over.installEventFilter(this);
}

void Floating::add(QWidget* widget) {
  const bool was_hidden = widget->isHidden();
  widget->setParent(&over_);
  widget->setVisible(!was_hidden);
  widget->installEventFilter(this);
  widgets_.emplace_back(widget);
  place();
}

bool Floating::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::Resize:
      if (watched == &over_) place();
      break;
    case QEvent::Show:
    case QEvent::Hide:
    case QEvent::LayoutRequest:
      if (watched != &over_) place();
      break;
    default:
      break;
  }
  return false;
}

void Floating::place() {
  const int width = std::min(kWidest, over_.width() - 2 * theme::kMargin);
  const int left = (over_.width() - width) / 2;
  int top = theme::kMargin;
  for (QWidget* widget : widgets_) {
    if (!widget || widget->isHidden()) continue;
    const int height = height_of(*widget, width);
    widget->setGeometry(left, top, width, height);
    widget->raise();
    top += height + theme::kSpacing;
  }
}

}  // namespace episcope

#include "moc_floating.cpp"
