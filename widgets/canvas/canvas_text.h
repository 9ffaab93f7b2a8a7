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

/// Fits a caption of parts, "name · number", into so many pixels by eliding the middle of its
/// longest part. Elides parts that end in a decimal number only if all parts do.
[[nodiscard]] QString fitted_caption(const QString& text, const QFontMetricsF& metrics,
                                     double room);

/// Depth to which a caption at the top of a canvas reaches.
[[nodiscard]] double caption_depth(const QFontMetricsF& metrics);

/// Draws text on a translucent dark plate in a corner of a canvas, legible on any picture and
/// fitted to the canvas, after the badge of a side. Returns the plate; draws nothing for an empty
/// text.
QRectF draw_plate(QPainter& painter, const QRectF& canvas, Qt::Alignment corner,
                  const QString& text, const QColor& color, Side side = Side::None);

/// Labels of one view, `[y][x]`; an empty image stands for zeros.
struct ScribbleLayers {
  ImageView<const std::uint8_t> painted;
  ImageView<const std::uint8_t> carried;  ///< From other views; drawn where nothing is painted.
};

/// Picture of the pixels of `rect` in label colors on a transparent ground: painted pixels opaque
/// in this style, carried pixels as fainter stripes. Unknown labels get their default color.
/// Linear in the pixels of `rect`, which lies inside the view.
[[nodiscard]] QImage scribble_picture(const ScribbleLayers& layers, const LabelSet& labels,
                                      const PixelRect& rect, const render::LabelStyle& style = {});

}  // namespace episcope
