// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/parts_label.h"

namespace episcope {
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

QString PartsLabel::tip() const {
  return parts_.join('\n');
}

}  // namespace episcope

#include "moc_parts_label.cpp"
