// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/canvas_geometry.h"

#include <QColor>
#include <QRegularExpression>
#include <QStringList>

#include <algorithm>
#include <array>
#include <cmath>

namespace episcope {

namespace {

constexpr double kPlateGap = 4;  // of a plate to the edges of the canvas

double plate_height(const QFontMetricsF& metrics) {
  return metrics.height() + 4;
}

bool ends_in_a_number(const QString& part) {
  static const QRegularExpression number("\\d\\.\\d+$");
  return number.match(part).hasMatch();
}

}  // namespace

QString fitted_caption(const QString& text, const QFontMetricsF& metrics, double room) {
  constexpr int kLeastLetters = 3;  // of the part that is elided
  const QString separator = QStringLiteral(" · ");
  QStringList parts = text.split(separator);
  const bool has_words = !std::ranges::all_of(parts, ends_in_a_number);
  const auto longest = std::ranges::max_element(parts, {}, [has_words](const QString& part) {
    return has_words && ends_in_a_number(part) ? 0 : part.size();
  });
  const double excess = metrics.horizontalAdvance(text) - room;
  const double left = metrics.horizontalAdvance(*longest) - excess;
  if (left < kLeastLetters * metrics.averageCharWidth()) {
    return metrics.elidedText(text, Qt::ElideMiddle, room);
  }
  if (excess > 0) *longest = metrics.elidedText(*longest, Qt::ElideMiddle, left);
  return parts.join(separator);
}

double caption_depth(const QFontMetricsF& metrics) {
  return kPlateGap + plate_height(metrics);
}

QRectF draw_plate(QPainter& painter, const QRectF& canvas, Qt::Alignment corner,
                  const QString& text, const QColor& color, Side side) {
  if (text.isEmpty()) return {};
  constexpr double kPadding = 5;
  const QFontMetricsF metrics(painter.font());
  const double height = plate_height(metrics);
  const double badge = side == Side::None ? 0 : height;
  const QRectF inside = canvas.adjusted(kPlateGap, kPlateGap, -kPlateGap, -kPlateGap);
  const QString fitting = fitted_caption(text, metrics, inside.width() - badge - 2 * kPadding + 1);
  QRectF plate(0, 0, metrics.horizontalAdvance(fitting) + 2 * kPadding + badge, height);
  plate.moveTopLeft(inside.topLeft());
  if (corner & Qt::AlignRight) plate.moveRight(inside.right());
  if (corner & Qt::AlignBottom) plate.moveBottom(inside.bottom());
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(0x14, 0x16, 0x18, 190));
  painter.drawRoundedRect(plate, 3, 3);
  draw_side(painter, QRectF(plate.left(), plate.top(), badge, height), side);
  painter.setPen(color);
  painter.drawText(plate.adjusted(badge, 0, 0, 0), Qt::AlignCenter, fitting);
  painter.restore();
  return plate;
}

namespace {

constexpr int kStripe = 5;       // px from one stripe to the next
constexpr int kStripeWidth = 2;  // px
constexpr int kStripeAlpha = 200;
constexpr int kBetweenAlpha = 70;

using Colors = std::array<QRgb, LabelSet::kMaxId + 1>;

Colors colors_of(const LabelSet& labels, const render::LabelStyle& style, int alpha) {
  Colors colors{};
  for (int id = 1; id <= LabelSet::kMaxId; ++id) {
    if (style.hidden.contains(id)) continue;
    const LabelInfo* label = labels.find(id);
    const Rgb rgb = label ? label->color : label_color(id);
    colors[static_cast<std::size_t>(id)] = qPremultiply(qRgba(rgb[0], rgb[1], rgb[2], alpha));
  }
  return colors;
}

}  // namespace

QImage scribble_picture(const ScribbleLayers& layers, const LabelSet& labels, const PixelRect& rect,
                        const render::LabelStyle& style) {
  if (rect.empty()) return {};
  QImage picture(rect.x1 - rect.x0, rect.y1 - rect.y0, QImage::Format_ARGB32_Premultiplied);
  picture.fill(Qt::transparent);
  const Colors opaque = colors_of(labels, style, 255);
  const Colors stripe = colors_of(labels, style, kStripeAlpha);
  const Colors between = colors_of(labels, style, kBetweenAlpha);
  const bool has_contours = style.drawing != render::LabelDrawing::Fill;
  const Colors within = style.drawing == render::LabelDrawing::Both
                            ? colors_of(labels, style, render::kFaintLabel)
                            : Colors{};
  for (int y = rect.y0; y < rect.y1; ++y) {
    auto* out = reinterpret_cast<QRgb*>(picture.scanLine(y - rect.y0));
    if (!layers.carried.empty()) {
      const std::uint8_t* carried = layers.carried.row(y);
      for (int x = rect.x0; x < rect.x1; ++x) {
        out[x - rect.x0] = ((x + y) % kStripe < kStripeWidth ? stripe : between)[carried[x]];
      }
    }
    if (layers.painted.empty()) continue;
    const std::uint8_t* painted = layers.painted.row(y);
    for (int x = rect.x0; x < rect.x1; ++x) {
      if (painted[x] == 0) continue;
      const bool is_full = !has_contours || render::is_on_contour(layers.painted, y, x);
      out[x - rect.x0] = (is_full ? opaque : within)[painted[x]];
    }
  }
  return picture;
}

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
