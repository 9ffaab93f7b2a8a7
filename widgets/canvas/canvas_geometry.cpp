// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/canvas_geometry.h"

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

namespace {

// Lines wherever `differs(y, x, y', x')` for neighbors; runs of them are one line each. Pixels
// from −1 to `height` and `width` are compared if `beyond` is 1, else only pixels of the image.
template <class Differs>
PixelEdges edges_where(int height, int width, int beyond, const Differs& differs) {
  PixelEdges edges;
  for (int y = 1 - beyond; y < height + beyond; ++y) {
    for (int x = 0; x < width;) {
      const int begin = x;
      while (x < width && differs(y - 1, x, y, x)) ++x;
      if (x > begin) edges.emplace_back(begin, y, x, y);
      if (x == begin) ++x;
    }
  }
  for (int x = 1 - beyond; x < width + beyond; ++x) {
    for (int y = 0; y < height;) {
      const int begin = y;
      while (y < height && differs(y, x - 1, y, x)) ++y;
      if (y > begin) edges.emplace_back(x, begin, x, y);
      if (y == begin) ++y;
    }
  }
  return edges;
}

}  // namespace

PixelEdges outline_of(ImageView<const std::uint8_t> mask, QPoint offset) {
  const auto is_inside = [&mask](int y, int x) {
    return y >= 0 && x >= 0 && y < mask.height && x < mask.width && mask.at(y, x) != 0;
  };
  PixelEdges edges = edges_where(mask.height, mask.width, 1, [&](int y0, int x0, int y1, int x1) {
    return is_inside(y0, x0) != is_inside(y1, x1);
  });
  for (QLine& edge : edges) edge.translate(offset);
  return edges;
}

PixelEdges boundaries_of(ImageView<const std::int32_t> labels, std::int32_t label,
                         Boundaries which) {
  return edges_where(labels.height, labels.width, 0, [&](int y0, int x0, int y1, int x1) {
    const std::int32_t a = labels.at(y0, x0);
    const std::int32_t b = labels.at(y1, x1);
    const bool is_of_label = a == label || b == label;
    return a != b && is_of_label == (which == Boundaries::OfLabel);
  });
}

}  // namespace episcope
