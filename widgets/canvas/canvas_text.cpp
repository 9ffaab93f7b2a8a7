// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/canvas_text.h"

#include <QRegularExpression>
#include <QStringList>

#include <algorithm>

namespace episcope {

namespace {

constexpr double kGap = 4;  // of a plate to the edges of the canvas

double plate_height(const QFontMetricsF& metrics) {
  return metrics.height() + 4;
}

bool ends_in_a_number(const QString& part) {
  static const QRegularExpression number("\\d\\.\\d+$");
  return number.match(part).hasMatch();
}

}  // namespace

QString fitted_caption(const QString& text, const QFontMetricsF& metrics, double room) {
  constexpr int kLeastLetters = 3;  // of the part that is elided
  const QString separator = QStringLiteral(" · ");
  QStringList parts = text.split(separator);
  const bool has_words = !std::ranges::all_of(parts, ends_in_a_number);
  const auto longest = std::ranges::max_element(parts, {}, [has_words](const QString& part) {
    return has_words && ends_in_a_number(part) ? 0 : part.size();
  });
  const double excess = metrics.horizontalAdvance(text) - room;
  const double left = metrics.horizontalAdvance(*longest) - excess;
  if (left < kLeastLetters * metrics.averageCharWidth()) {
    return metrics.elidedText(text, Qt::ElideMiddle, room);
  }
  if (excess > 0) *longest = metrics.elidedText(*longest, Qt::ElideMiddle, left);
  return parts.join(separator);
}

double caption_depth(const QFontMetricsF& metrics) {
  return kGap + plate_height(metrics);
}

QRectF draw_plate(QPainter& painter, const QRectF& canvas, Qt::Alignment corner,
                  const QString& text, const QColor& color, Side side) {
  if (text.isEmpty()) return {};
  constexpr double kPadding = 5;
  const QFontMetricsF metrics(painter.font());
  const double height = plate_height(metrics);
  const double badge = side == Side::None ? 0 : height;
  const QRectF inside = canvas.adjusted(kGap, kGap, -kGap, -kGap);
  const QString fitting = fitted_caption(text, metrics, inside.width() - badge - 2 * kPadding + 1);
  QRectF plate(0, 0, metrics.horizontalAdvance(fitting) + 2 * kPadding + badge, height);
  plate.moveTopLeft(inside.topLeft());
  if (corner & Qt::AlignRight) plate.moveRight(inside.right());
  if (corner & Qt::AlignBottom) plate.moveBottom(inside.bottom());
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(0x14, 0x16, 0x18, 190));
  painter.drawRoundedRect(plate, 3, 3);
  draw_side(painter, QRectF(plate.left(), plate.top(), badge, height), side);
  painter.setPen(color);
  painter.drawText(plate.adjusted(badge, 0, 0, 0), Qt::AlignCenter, fitting);
  painter.restore();
  return plate;
}

}  // namespace episcope
