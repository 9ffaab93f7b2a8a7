// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/style/painted_icon_engine.h"

#include <QPainter>
#include <QPixmap>
#include <QPixmapCache>

namespace episcope {

QPixmap PaintedIconEngine::pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) {
  const QString key =
      QStringLiteral("episcope icon %1x%2 ").arg(size.width()).arg(size.height()) + look(mode);
  QPixmap pixmap;
  if (QPixmapCache::find(key, &pixmap)) return pixmap;
  pixmap = QPixmap(size);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  paint(&painter, {{0, 0}, size}, mode, state);
  painter.end();
  QPixmapCache::insert(key, pixmap);
  return pixmap;
}

}  // namespace episcope
