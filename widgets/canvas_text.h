// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QPainter>
#include <QRectF>
#include <QString>

namespace episcope {

/// Text on a translucent dark plate in a corner of a canvas, legible on any picture. Gives the
/// plate back; draws nothing for an empty text.
QRectF draw_plate(QPainter& painter, const QRectF& canvas, Qt::Alignment corner,
                  const QString& text, const QColor& color);

}  // namespace episcope
