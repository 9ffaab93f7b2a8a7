// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/style/side.h"

#include <QFontMetricsF>
#include <QPainter>
#include <QRectF>
#include <QString>

namespace episcope {

/// A caption of parts, "name · number", in so many pixels: what is too long is elided in the middle
/// of the longest part, so that the others can be read; one that ends in a decimal number only if
/// all do.
[[nodiscard]] QString fitted_caption(const QString& text, const QFontMetricsF& metrics,
                                     double room);

/// How far a caption at the top of a canvas reaches down in it.
[[nodiscard]] double caption_depth(const QFontMetricsF& metrics);

/// Text on a translucent dark plate in a corner of a canvas, legible on any picture. Gives the
/// plate back; draws nothing for an empty text. The badge of a side stands before the text; the
/// text is fitted to the canvas.
QRectF draw_plate(QPainter& painter, const QRectF& canvas, Qt::Alignment corner,
                  const QString& text, const QColor& color, Side side = Side::None);

}  // namespace episcope
