// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/scribble_layer.h"
#include "engine/core/image.h"
#include "engine/render/shade.h"
#include "widgets/controls/theme.h"

#include <QFontMetricsF>
#include <QImage>
#include <QLine>
#include <QPainter>
#include <QPoint>
#include <QPointF>
#include <QRectF>
#include <QSizeF>
#include <QString>

#include <cstdint>
#include <optional>
#include <vector>

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

/// Zoom and pan of a canvas, shared by linked viewports. Image coordinates are continuous: pixel
/// (y, x) covers [x, x + 1) × [y, y + 1). Widget coordinates are logical pixels.
struct CanvasTransform {
  double scale = 1;  ///< Logical pixels per image pixel.
  QPointF center;    ///< Image point in the middle of the widget.

  [[nodiscard]] QPointF to_widget(QPointF image, QSizeF widget) const;
  [[nodiscard]] QPointF to_image(QPointF point, QSizeF widget) const;
  /// Zooms by `factor` around `anchor` (widget coordinates).
  [[nodiscard]] CanvasTransform zoomed(double factor, QPointF anchor, QSizeF widget) const;
  /// Moves the picture by `delta` logical pixels.
  [[nodiscard]] CanvasTransform panned(QPointF delta) const;
  friend bool operator==(const CanvasTransform&, const CanvasTransform&) = default;
};

/// Scale limits of all canvases.
inline constexpr double kMinCanvasScale = 1.0 / 64;
inline constexpr double kMaxCanvasScale = 128;

/// Zoom factor of a key press or a notch of the wheel.
inline constexpr double kCanvasZoomStep = 1.25;
/// `angle` as in QWheelEvent::angleDelta: 120 per notch.
[[nodiscard]] double wheel_zoom(double angle);

/// Fits the whole image into the widget, with `margin` logical pixels around it.
[[nodiscard]] CanvasTransform fit_transform(QSizeF image, QSizeF widget, double margin = 4);

/// A line between pixels, from corner to corner.
using PixelEdges = std::vector<QLine>;

/// Outline of the nonzero pixels of a mask whose first pixel lies at `offset`.
[[nodiscard]] PixelEdges outline_of(ImageView<const std::uint8_t> mask, QPoint offset);

/// Edges between pixels of different labels, within the image: edges of `label`, or all others.
/// Coordinates as in `labels`.
enum class Boundaries { OfLabel, Others };
[[nodiscard]] PixelEdges boundaries_of(ImageView<const std::int32_t> labels, std::int32_t label,
                                       Boundaries which);

/// A named point on a picture. Places are in image coordinates (CanvasTransform).
struct CanvasMark {
  QPointF at;
  /// Expected place, connected by a line.
  std::optional<QPointF> wanted{};
  QString name{};
  bool is_emphasised = false;
  friend bool operator==(const CanvasMark&, const CanvasMark&) = default;
};

}  // namespace episcope
