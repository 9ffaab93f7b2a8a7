// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/elided_label.h"

#include <QEvent>

namespace episcope {

ElidedLabel::ElidedLabel(QWidget* parent, Qt::TextElideMode mode) : QLabel(parent), mode_(mode) {
  setTextFormat(Qt::PlainText);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void ElidedLabel::setFullText(const QString& text) {
  full_text_ = text;
  updateGeometry();
  elide();
}

QSize ElidedLabel::sizeHint() const {
  return {fontMetrics().horizontalAdvance(full_text_) + 2, fontMetrics().height()};
}

QSize ElidedLabel::minimumSizeHint() const {
  return {24, fontMetrics().height()};
}

QString ElidedLabel::shortened(int room) const {
  return fontMetrics().elidedText(full_text_, mode_, room);
}

void ElidedLabel::elide() {
  const QString shown = shortened(contentsRect().width());
  setToolTip(shown == full_text_ ? QString() : tip());
  if (shown != text()) setText(shown);
}

void ElidedLabel::resizeEvent(QResizeEvent* event) {
  QLabel::resizeEvent(event);
  elide();
}

void ElidedLabel::changeEvent(QEvent* event) {
  QLabel::changeEvent(event);
  if (event->type() == QEvent::FontChange) elide();
}

}  // namespace episcope

#include "moc_elided_label.cpp"
