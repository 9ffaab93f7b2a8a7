// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/label_set.h"
#include "annotation/scribble_layer.h"
#include "engine/core/image.h"
#include "engine/render/shade.h"
#include "widgets/controls/theme.h"

#include <QFontMetricsF>
#include <QImage>
#include <QPainter>
#include <QRectF>
#include <QString>

#include <cstdint>

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

/// The labels of one view, `[y][x]`; an empty image stands for zeros.
struct ScribbleLayers {
  ImageView<const std::uint8_t> painted;
  ImageView<const std::uint8_t> carried;  ///< From other views; drawn where nothing is painted.
};

/// The pixels of `rect`, in the colours of the labels, on a transparent ground: painted ones
/// opaque and in this style, carried ones as fainter stripes. Unknown labels get their default
/// colour. Linear in the pixels of `rect`, which lies inside the view.
[[nodiscard]] QImage scribble_picture(const ScribbleLayers& layers, const LabelSet& labels,
                                      const PixelRect& rect, const render::LabelStyle& style = {});

}  // namespace episcope
