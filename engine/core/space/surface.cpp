// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/space/surface.h"

#include "engine/core/error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace episcope {
namespace {

constexpr std::int32_t kMissing = -1;

/// A point as a corner of a cell: its place in the cloud and its disparity.
struct Corner {
  std::int32_t point;
  float disparity_px;
};

/// Which point is where, `[y / step][x / step]`.
Image<std::int32_t> points_by_place(const PointCloud& cloud, const DisparityView& view, int step) {
  const auto rows = [step](int pixels) { return (pixels + step - 1) / step; };
  Image<std::int32_t> points(rows(view.disparity.height), rows(view.disparity.width), 1, kMissing);
  for (std::size_t i = 0; i < cloud.pixels.size(); ++i) {
    points.at(cloud.pixels[i].y / step, cloud.pixels[i].x / step) = static_cast<std::int32_t>(i);
  }
  return points;
}

class Joiner {
 public:
  Joiner(PointCloud& cloud, double most_px) : cloud_(cloud), most_px_(most_px) {}

  /// Corners of a cell, counter-clockwise as the viewer sees them.
  void join(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
    const bool along_ac =
        b.point == kMissing || d.point == kMissing ||
        (a.point != kMissing && c.point != kMissing &&
         std::abs(a.disparity_px - c.disparity_px) <= std::abs(b.disparity_px - d.disparity_px));
    if (along_ac) {
      add(a, b, c);
      add(a, c, d);
    } else {
      add(a, b, d);
      add(b, c, d);
    }
  }

 private:
  void add(const Corner& a, const Corner& b, const Corner& c) {
    if (std::min({a.point, b.point, c.point}) == kMissing) return;
    const auto [low, high] = std::minmax({a.disparity_px, b.disparity_px, c.disparity_px});
    if (high - low > most_px_) return;
    cloud_.triangles.push_back({static_cast<std::uint32_t>(a.point),
                                static_cast<std::uint32_t>(b.point),
                                static_cast<std::uint32_t>(c.point)});
  }

  PointCloud& cloud_;
  double most_px_;
};

}  // namespace

void join_to_surface(PointCloud& cloud, const DisparityView& view, int step, double jump_px) {
  if (!(jump_px > 0)) throw InvalidInput("a surface needs a jump of more than 0 px to be cut at");
  const Image<std::int32_t> points = points_by_place(cloud, view, step);
  const auto corner = [&](int row, int column) -> Corner {
    const std::int32_t point = points.at(row, column);
    if (point == kMissing) return {kMissing, 0};
    const PixelIndex pixel = cloud.pixels[static_cast<std::size_t>(point)];
    return {point, view.disparity.at(pixel.y, pixel.x)};
  };
  cloud.triangles.clear();
  cloud.triangles.reserve(2 * cloud.pixels.size());
  Joiner joiner(cloud, jump_px * step);
  for (int row = 0; row + 1 < points.height(); ++row) {
    for (int column = 0; column + 1 < points.width(); ++column) {
      joiner.join(corner(row, column), corner(row + 1, column), corner(row + 1, column + 1),
                  corner(row, column + 1));
    }
  }
}

}  // namespace episcope
