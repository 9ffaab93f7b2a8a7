// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas_text.h"

#include <QFontMetricsF>

namespace episcope {

QRectF draw_plate(QPainter& painter, const QRectF& canvas, Qt::Alignment corner,
                  const QString& text, const QColor& color) {
  if (text.isEmpty()) return {};
  constexpr double kGap = 4;
  const QFontMetricsF metrics(painter.font());
  QRectF plate(0, 0, metrics.horizontalAdvance(text) + 10, metrics.height() + 4);
  const QRectF inside = canvas.adjusted(kGap, kGap, -kGap, -kGap);
  plate.moveTopLeft(inside.topLeft());
  if (corner & Qt::AlignRight) plate.moveRight(inside.right());
  if (corner & Qt::AlignBottom) plate.moveBottom(inside.bottom());
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(0x14, 0x16, 0x18, 190));
  painter.drawRoundedRect(plate, 3, 3);
  painter.setPen(color);
  painter.drawText(plate, Qt::AlignCenter, text);
  painter.restore();
  return plate;
}

}  // namespace episcope
