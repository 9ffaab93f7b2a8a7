// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/depth/tile_raster.h"

#include <algorithm>
#include <cmath>

namespace episcope::capture {
namespace {

constexpr int kPixels = kTile * kTile;

int pixel_of(float at) {
  return static_cast<int>(std::floor(std::clamp(at, -1e6F, 1e6F) + 0.5F));
}

/// The edges of a triangle: positive inside, and how much they change within a pixel.
struct Edges {
  HalfPlane edge[3];
  double margin[3];

  explicit Edges(const Polygon& polygon) {
    const double turn = twice_area(polygon) > 0 ? 1 : -1;
    for (int i = 0; i < 3; ++i) {
      const Corner& p = polygon.corners[i];
      const Corner& q = polygon.corners[(i + 1) % 3];
      const double a = turn * (p.y - q.y);
      const double b = turn * (q.x - p.x);
      edge[i] = {a, b, -a * p.x - b * p.y};
      margin[i] = (std::abs(a) + std::abs(b)) / 2;
    }
  }
  enum class Pixel { Outside, Crossed, Inside };
  [[nodiscard]] Pixel pixel(const Corner& center) const {
    bool is_inside = true;
    for (int i = 0; i < 3; ++i) {
      const double at = edge[i].at(center);
      if (at <= -margin[i]) return Pixel::Outside;
      is_inside = is_inside && at >= margin[i];
    }
    return is_inside ? Pixel::Inside : Pixel::Crossed;
  }
};

void set_range(const Polygon& polygon, const InversePlane& plane, Fragment& fragment) {
  fragment.near = 0;
  fragment.far = 2e38F;
  for (int i = 0; i < polygon.count; ++i) {
    const auto w = static_cast<float>(plane.at(polygon.corners[i]));
    fragment.near = std::max(fragment.near, w);
    fragment.far = std::min(fragment.far, w);
  }
}

/// The triangle within a pixel at `center`, both relative to the same origin.
void cut_to_pixel(const ScreenTriangle& triangle, const Corner& center, Fragment& fragment) {
  Polygon polygon = triangle.polygon;
  for (int i = 0; i < polygon.count; ++i) {
    polygon.corners[i].x -= center.x;
    polygon.corners[i].y -= center.y;
  }
  polygon = clipped_to_pixel(polygon);
  fragment.area = static_cast<float>(std::abs(twice_area(polygon)) / 2);
  InversePlane plane = triangle.plane;
  plane.at_zero = plane.at(center);
  set_range(polygon, plane, fragment);
}

void fill_pixel(const InversePlane& plane, const Corner& center, Fragment& fragment) {
  const double reach = (std::abs(plane.by_x) + std::abs(plane.by_y)) / 2;
  const double middle = plane.at(center);
  fragment.area = 1;
  fragment.near = static_cast<float>(middle + reach);
  fragment.far = static_cast<float>(middle - reach);
}

}  // namespace

TileRaster::TileRaster(const RasterInput& input)
    : input_(input), resolver_(input.jump), starts_(kPixels + 1), cover_(kPixels), far_(kPixels) {}

ScreenTriangle TileRaster::triangle(std::uint32_t face, int x, int y) const {
  ScreenTriangle triangle = around_pixel(input_.corners(face), x, y);
  triangle.is_front = triangle.is_front || input_.both_sides;
  return triangle;
}

void TileRaster::gather(int tile) {
  const TileBins& bins = *input_.bins;
  left_ = tile % bins.tiles_across() * kTile;
  top_ = tile / bins.tiles_across() * kTile;
  right_ = std::min(left_ + kTile, input_.width) - 1;
  bottom_ = std::min(top_ + kTile, input_.height) - 1;
  fragments_.clear();
  std::ranges::fill(cover_, 0.0F);
  std::ranges::fill(far_, 2e38F);
  for (const bool is_front : {true, false}) {
    for (int chunk = 0; chunk < bins.chunk_count(); ++chunk) {
      for (const std::uint32_t face : bins.faces(chunk, tile, is_front)) add_face(face, is_front);
    }
  }
}

void TileRaster::add_fragment(Fragment fragment) {
  if (!(fragment.area > 0)) return;
  if (fragment.is_front) {
    cover_[fragment.pixel] += fragment.area;
    far_[fragment.pixel] = std::min(far_[fragment.pixel], fragment.far);
  }
  fragments_.push_back(fragment);
}

void TileRaster::add_face(std::uint32_t face, bool is_front) {
  const std::array<ScreenVertex, 3> v = input_.corners(face);
  const auto [low_x, high_x] = std::minmax({v[0].x, v[1].x, v[2].x});
  const auto [low_y, high_y] = std::minmax({v[0].y, v[1].y, v[2].y});
  const auto [far, near] = std::minmax({v[0].w, v[1].w, v[2].w});
  const int x0 = pixel_of(low_x);
  const int x1 = pixel_of(high_x);
  const int y0 = pixel_of(low_y);
  const int y1 = pixel_of(high_y);
  const auto local = [&](int y, int x) { return (y - top_) * kTile + x - left_; };
  Fragment fragment{face, 0, near, far, 0, is_front};
  if (x0 == x1 && y0 == y1) {
    if (x0 < left_ || x0 > right_ || y0 < top_ || y0 > bottom_) return;
    fragment.pixel = static_cast<std::uint16_t>(local(y0, x0));
    if (!is_front && is_hidden(fragment.pixel, near)) return;
    fragment.area = static_cast<float>(std::abs(turn_of(v)) / 2);
    return add_fragment(fragment);
  }
  const ScreenTriangle whole = around_pixel(v, x0, y0);
  const Edges edges(whole.polygon);
  for (int y = std::max(y0, top_); y <= std::min(y1, bottom_); ++y) {
    for (int x = std::max(x0, left_); x <= std::min(x1, right_); ++x) {
      fragment.pixel = static_cast<std::uint16_t>(local(y, x));
      if (!is_front && is_hidden(fragment.pixel, near)) continue;
      const Corner center{static_cast<double>(x - x0), static_cast<double>(y - y0)};
      const Edges::Pixel pixel = edges.pixel(center);
      if (pixel == Edges::Pixel::Outside) continue;
      if (pixel == Edges::Pixel::Inside) {
        fill_pixel(whole.plane, center, fragment);
      } else {
        cut_to_pixel(whole, center, fragment);
      }
      add_fragment(fragment);
    }
  }
}

void TileRaster::sort() {
  std::ranges::fill(starts_, 0U);
  for (const Fragment& f : fragments_) ++starts_[f.pixel + 1];
  for (int p = 0; p < kPixels; ++p) starts_[p + 1] += starts_[p];
  sorted_.resize(fragments_.size());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (const Fragment& f : fragments_) sorted_[next[f.pixel]++] = f;
}

}  // namespace episcope::capture
