// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/outline.h"

namespace episcope {
namespace {

// Lines wherever `differs(y, x, y', x')` for neighbours; runs of them are one line each. Pixels
// from −1 to `height` and `width` are asked for if `beyond` is 1, else those of the image.
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
