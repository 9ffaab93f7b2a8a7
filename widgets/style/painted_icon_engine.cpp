// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/style/painted_icon_engine.h"

#include <QPainter>
#include <QPixmap>

namespace episcope {

QPixmap PaintedIconEngine::pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) {
  QPixmap pixmap(size);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  paint(&painter, {{0, 0}, size}, mode, state);
  return pixmap;
}

}  // namespace episcope
