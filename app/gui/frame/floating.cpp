// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/floating.h"

#include "widgets/canvas/canvas_text.h"
#include "widgets/style/theme.h"

#include <QEvent>
#include <QtMath>

#include <algorithm>

namespace episcope {
namespace {

constexpr int kWidest = 760;  // longer lines are hard to read

int height_of(const QWidget& widget, int width) {
  return widget.hasHeightForWidth() ? widget.heightForWidth(width) : widget.sizeHint().height();
}

}  // namespace

Floating::Floating(QWidget& parent) : QObject(&parent), parent_(parent) {
  setArea(&parent);
}

void Floating::setArea(QWidget* area) {
  area_ = area;
  area->installEventFilter(this);
  place();
}

void Floating::add(QWidget* widget) {
  const bool was_hidden = widget->isHidden();
  widget->setParent(&parent_);
  widget->setVisible(!was_hidden);
  widget->installEventFilter(this);
  widgets_.emplace_back(widget);
  place();
}

bool Floating::eventFilter(QObject* watched, QEvent* event) {
  switch (event->type()) {
    case QEvent::Resize:
    case QEvent::Move:
      if (watched == area_) place();
      break;
    case QEvent::Show:
    case QEvent::Hide:
    case QEvent::LayoutRequest:
      if (watched != area_) place();
      break;
    default:
      break;
  }
  return false;
}

void Floating::place() {
  if (!area_) return;
  const int width = std::min(kWidest, area_->width() - 2 * theme::kMargin);
  const int top = qCeil(caption_depth(QFontMetricsF(parent_.font()))) + theme::kSpacing;
  QPoint corner = area_->mapTo(&parent_, QPoint((area_->width() - width) / 2, top));
  for (QWidget* widget : widgets_) {
    if (!widget || widget->isHidden()) continue;
    const int height = height_of(*widget, width);
    widget->setGeometry(QRect(corner, QSize(width, height)));
    widget->raise();
    corner.ry() += height + theme::kSpacing;
  }
}

}  // namespace episcope

#include "moc_floating.cpp"
