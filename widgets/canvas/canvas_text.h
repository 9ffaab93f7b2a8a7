// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/style/side.h"

#include <QPainter>
#include <QRectF>
#include <QString>

namespace episcope {

/// Text on a translucent dark plate in a corner of a canvas, legible on any picture. Gives the
/// plate back; draws nothing for an empty text. The badge of a side stands before the text; a text
/// too long for the canvas is elided in the middle.
QRectF draw_plate(QPainter& painter, const QRectF& canvas, Qt::Alignment corner,
                  const QString& text, const QColor& color, Side side = Side::None);

}  // namespace episcope
