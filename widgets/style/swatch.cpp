// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/style/swatch.h"

#include "widgets/style/theme.h"

#include <QPainter>

namespace episcope {

QIcon swatch(const Rgb& rgb, const QPalette& palette) {
  QPixmap pixmap(2 * kSwatchSize, 2 * kSwatchSize);
  pixmap.setDevicePixelRatio(2);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(theme::blend(palette.color(QPalette::Base), palette.color(QPalette::Text), 0.5));
  painter.setBrush(QColor(rgb[0], rgb[1], rgb[2]));
  painter.drawRoundedRect(QRectF(1.5, 1.5, kSwatchSize - 3, kSwatchSize - 3), 3, 3);
  painter.end();
  QIcon icon(pixmap);
  icon.addPixmap(pixmap, QIcon::Selected);
  return icon;
}

}  // namespace episcope
