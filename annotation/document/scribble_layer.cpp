// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/document/scribble_layer.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope {
namespace {

bool is_blank(const Image<std::uint8_t>& view) {
  return std::all_of(view.begin(), view.end(), [](std::uint8_t label) { return label == 0; });
}

bool same_labels(const Image<std::uint8_t>& a, const Image<std::uint8_t>& b) {
  if (a.empty()) return is_blank(b);
  if (b.empty()) return is_blank(a);
  return std::equal(a.begin(), a.end(), b.begin());
}

}  // namespace

ScribbleLayer::ScribbleLayer(GridShape grid, int height, int width)
    : grid_(grid), height_(height), width_(width) {
  if (grid.v < 1 || grid.u < 1 || std::min(height, width) < 1 ||
      std::max(height, width) > kMaxExtent) {
    throw InvalidInput(
        fmt::format("scribbles cannot be painted on {}×{} views of {}×{} px; views may have 1 to "
                    "65535 rows and columns",
                    grid.v, grid.u, height, width));
  }
  views_.resize(static_cast<std::size_t>(grid.count()));
}

std::size_t ScribbleLayer::place(ViewIndex view) const {
  if (!grid_.contains(view)) {
    throw InvalidInput(fmt::format("the view ({}) lies outside the grid of {}×{} views",
                                   view_text(view), grid_.v, grid_.u));
  }
  return static_cast<std::size_t>(view.v) * grid_.u + view.u;
}

ImageView<const std::uint8_t> ScribbleLayer::view(ViewIndex view) const {
  const Image<std::uint8_t>& image = views_[place(view)];
  return image.empty() ? ImageView<const std::uint8_t>{} : image.view();
}

ImageView<std::uint8_t> ScribbleLayer::writable_view(ViewIndex view) {
  Image<std::uint8_t>& image = views_[place(view)];
  if (image.empty()) image = Image<std::uint8_t>(height_, width_);
  return image.view();
}

int ScribbleLayer::label_at(ViewIndex view, PixelIndex pixel) const {
  const Image<std::uint8_t>& image = views_[place(view)];
  const bool is_inside = pixel.y >= 0 && pixel.y < height_ && pixel.x >= 0 && pixel.x < width_;
  return image.empty() || !is_inside ? 0 : image.at(pixel.y, pixel.x);
}

std::vector<ViewIndex> ScribbleLayer::painted_views() const {
  std::vector<ViewIndex> painted;
  for (int i = 0; i < grid_.count(); ++i) {
    if (!is_blank(views_[static_cast<std::size_t>(i)])) painted.push_back(grid_.view_at(i));
  }
  return painted;
}

std::size_t ScribbleLayer::byte_size() const {
  std::size_t bytes = 0;
  for (const Image<std::uint8_t>& view : views_) bytes += view.size();
  return bytes;
}

bool operator==(const ScribbleLayer& a, const ScribbleLayer& b) {
  return a.grid_ == b.grid_ && a.height_ == b.height_ && a.width_ == b.width_ &&
         std::equal(a.views_.begin(), a.views_.end(), b.views_.begin(), same_labels);
}

}  // namespace episcope
