// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"

#include <QLine>
#include <QPoint>
#include <QPointF>
#include <QRectF>
#include <QSizeF>
#include <QString>

#include <cstdint>
#include <optional>
#include <vector>

namespace episcope {

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
