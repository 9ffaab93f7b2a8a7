// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/labels.h"

#include "widgets/controls/text.h"

#include <QEvent>
#include <QMouseEvent>
#include <QTextLayout>

#include <algorithm>

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

namespace {

constexpr int kSlack = 2;  // A line must not wrap again where the label draws it.
constexpr int kLeastLabelWidth = 24;

}  // namespace

FoldedLabel::FoldedLabel(QWidget* parent, int lines) : QLabel(parent), lines_(lines) {
  setTextFormat(Qt::PlainText);
  setWordWrap(true);
  setAlignment(Qt::AlignLeft | Qt::AlignTop);
}

void FoldedLabel::setFullText(const QString& text) {
  full_text_ = text;
  setAccessibleDescription(text);
  fold();
}

QSize FoldedLabel::sizeHint() const {
  const int width = fontMetrics().horizontalAdvance(full_text_) + kSlack;
  return {width, fontMetrics().height()};
}

QSize FoldedLabel::minimumSizeHint() const {
  return {kLeastLabelWidth, fontMetrics().height()};
}

int FoldedLabel::heightForWidth(int width) const {
  const int lines = std::max(1, static_cast<int>(linesAt(width).size()));
  return fontMetrics().height() + (lines - 1) * fontMetrics().lineSpacing();
}

QStringList FoldedLabel::linesAt(int width) const {
  const QString text = breakable(full_text_);
  const int room = std::max(kLeastLabelWidth, width) - kSlack;
  QTextLayout layout(text, font());
  QTextOption option;
  option.setWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere);
  layout.setTextOption(option);
  layout.beginLayout();
  QStringList lines;
  for (QTextLine line = layout.createLine(); line.isValid(); line = layout.createLine()) {
    line.setLineWidth(room);
    if (!is_open_ && lines.size() == lines_ - 1) {
      lines << fontMetrics().elidedText(text.mid(line.textStart()), Qt::ElideRight, room);
      break;
    }
    lines << text.mid(line.textStart(), line.textLength()).trimmed();
  }
  layout.endLayout();
  return lines;
}

void FoldedLabel::fold() {
  const QStringList lines = linesAt(contentsRect().width());
  const bool is_folded = !lines.isEmpty() && lines.back().endsWith(QChar(0x2026));
  const bool can_fold = is_folded || (is_open_ && lines.size() > lines_);
  setToolTip(is_folded ? full_text_ : QString());
  setCursor(can_fold ? Qt::PointingHandCursor : Qt::ArrowCursor);
  if (const QString shown = lines.join('\n'); shown != text()) setText(shown);
  updateGeometry();
}

void FoldedLabel::resizeEvent(QResizeEvent* event) {
  QLabel::resizeEvent(event);
  fold();
}

void FoldedLabel::changeEvent(QEvent* event) {
  QLabel::changeEvent(event);
  if (event->type() == QEvent::FontChange) fold();
}

void FoldedLabel::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !rect().contains(event->position().toPoint())) return;
  setOpen(!is_open_);
  emit toggled(is_open_);
}

void FoldedLabel::setOpen(bool is_open) {
  is_open_ = is_open;
  fold();
}

namespace {

const QString kBetween = QStringLiteral(" · ");

}  // namespace

void PartsLabel::setParts(const QStringList& parts) {
  if (parts == parts_) return;
  parts_ = parts;
  setFullText(parts_.join(kBetween));
}

QString PartsLabel::textOf(qsizetype count) const {
  QStringList shown = parts_.mid(0, count);
  if (count < parts_.size()) shown << tr("+%1 more").arg(parts_.size() - count);
  return shown.join(kBetween);
}

QString PartsLabel::shortened(int room) const {
  qsizetype count = parts_.size();
  while (count > 1 && fontMetrics().horizontalAdvance(textOf(count)) > room) --count;
  return fontMetrics().elidedText(textOf(count), Qt::ElideRight, room);
}

}  // namespace episcope

#include "moc_labels.cpp"
