// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/scribble_picture.h"

#include <QColor>

#include <array>

namespace episcope {
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

}  // namespace episcope
