// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QPointF>
#include <QRectF>
#include <QSizeF>

namespace episcope {

/// Zoom and pan of a canvas, a value that linked viewports share. Image coordinates are continuous:
/// pixel (y, x) covers [x, x + 1) × [y, y + 1). Widget coordinates are logical pixels.
struct CanvasTransform {
  double scale = 1;  ///< Logical pixels per image pixel.
  QPointF center;    ///< Image point in the middle of the widget.

  [[nodiscard]] QPointF to_widget(QPointF image, QSizeF widget) const;
  [[nodiscard]] QPointF to_image(QPointF point, QSizeF widget) const;
  /// Zoomed by `factor` so that the image point under `anchor` (widget coordinates) stays there.
  [[nodiscard]] CanvasTransform zoomed(double factor, QPointF anchor, QSizeF widget) const;
  /// Moved by `delta` logical pixels, the picture following.
  [[nodiscard]] CanvasTransform panned(QPointF delta) const;
  friend bool operator==(const CanvasTransform&, const CanvasTransform&) = default;
};

/// Scale limits of every canvas.
inline constexpr double kMinCanvasScale = 1.0 / 64;
inline constexpr double kMaxCanvasScale = 128;

/// Zoom factor of a key, and of a notch of the wheel.
inline constexpr double kCanvasZoomStep = 1.25;
/// `angle` as in QWheelEvent::angleDelta: 120 a notch.
[[nodiscard]] double wheel_zoom(double angle);

/// The whole image in the middle of the widget, with a margin of `margin` logical pixels.
[[nodiscard]] CanvasTransform fit_transform(QSizeF image, QSizeF widget, double margin = 4);

}  // namespace episcope
