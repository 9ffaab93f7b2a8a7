// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/parts_label.h"

#include <QEvent>

namespace episcope {
namespace {

const QString kBetween = QStringLiteral(" · ");

}  // namespace

PartsLabel::PartsLabel(QWidget* parent) : QLabel(parent) {
  setTextFormat(Qt::PlainText);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void PartsLabel::setParts(const QStringList& parts) {
  if (parts == parts_) return;
  parts_ = parts;
  updateGeometry();
  fit();
}

QString PartsLabel::fullText() const {
  return parts_.join(kBetween);
}

QString PartsLabel::textOf(qsizetype count) const {
  QStringList shown = parts_.mid(0, count);
  if (count < parts_.size()) shown << tr("+%1 more").arg(parts_.size() - count);
  return shown.join(kBetween);
}

QSize PartsLabel::sizeHint() const {
  return {fontMetrics().horizontalAdvance(fullText()) + 2, fontMetrics().height()};
}

QSize PartsLabel::minimumSizeHint() const {
  return {24, fontMetrics().height()};
}

void PartsLabel::fit() {
  const int room = contentsRect().width();
  qsizetype count = parts_.size();
  while (count > 1 && fontMetrics().horizontalAdvance(textOf(count)) > room) --count;
  const QString shown = fontMetrics().elidedText(textOf(count), Qt::ElideRight, room);
  setToolTip(shown == fullText() ? QString() : parts_.join('\n'));
  if (shown != text()) setText(shown);
}

void PartsLabel::resizeEvent(QResizeEvent* event) {
  QLabel::resizeEvent(event);
  fit();
}

void PartsLabel::changeEvent(QEvent* event) {
  QLabel::changeEvent(event);
  if (event->type() == QEvent::FontChange) fit();
}

}  // namespace episcope

#include "moc_parts_label.cpp"
