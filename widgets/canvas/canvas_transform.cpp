// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/canvas_transform.h"

#include <algorithm>
#include <cmath>

namespace episcope {

QPointF CanvasTransform::to_widget(QPointF image, QSizeF widget) const {
  return (image - center) * scale + QPointF(widget.width(), widget.height()) / 2;
}

QPointF CanvasTransform::to_image(QPointF point, QSizeF widget) const {
  return (point - QPointF(widget.width(), widget.height()) / 2) / scale + center;
}

CanvasTransform CanvasTransform::zoomed(double factor, QPointF anchor, QSizeF widget) const {
  CanvasTransform result;
  result.scale = std::clamp(scale * factor, kMinCanvasScale, kMaxCanvasScale);
  const QPointF from_middle = anchor - QPointF(widget.width(), widget.height()) / 2;
  result.center = to_image(anchor, widget) - from_middle / result.scale;
  return result;
}

CanvasTransform CanvasTransform::panned(QPointF delta) const {
  return {scale, center - delta / scale};
}

double wheel_zoom(double angle) {
  return std::pow(kCanvasZoomStep, angle / 120);
}

CanvasTransform fit_transform(QSizeF image, QSizeF widget, double margin) {
  CanvasTransform result;
  result.center = QPointF(image.width(), image.height()) / 2;
  if (image.isEmpty()) return result;
  const double across = std::max(1.0, widget.width() - 2 * margin) / image.width();
  const double down = std::max(1.0, widget.height() - 2 * margin) / image.height();
  result.scale = std::clamp(std::min(across, down), kMinCanvasScale, kMaxCanvasScale);
  return result;
}

}  // namespace episcope
