// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/paint/polygon.h"

#include "engine/core/error.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope {
namespace {

/// Where an edge crosses the middle of a row, and whether it goes up or down there.
struct Crossing {
  double x = 0;
  int winding = 0;
};

std::vector<Crossing> crossings_at(double y, std::span<const StrokePoint> corners) {
  std::vector<Crossing> crossings;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const StrokePoint& a = corners[i];
    const StrokePoint& b = corners[(i + 1) % corners.size()];
    // Half-open, so that a corner on the row counts once.
    if ((a.y <= y) == (b.y <= y)) continue;
    const double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
    crossings.push_back({x, a.y < b.y ? 1 : -1});
  }
  std::ranges::sort(crossings, {}, &Crossing::x);
  return crossings;
}

// The first pixel whose centre does not lie left of `x`.
int first_at(double x, int width) {
  return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(width)));
}

void add_row(int y, int width, const std::vector<Crossing>& crossings, PixelRegion& region) {
  int winding = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    winding += crossings[i].winding;
    if (winding == 0) continue;
    const int x0 = first_at(crossings[i].x, width);
    const int x1 = first_at(crossings[i + 1].x, width);
    if (x0 >= x1) continue;
    const bool continues = !region.empty() && region.back().y == y && region.back().x1 == x0;
    if (continues) {
      region.back().x1 = x1;
    } else {
      region.push_back({y, x0, x1});
    }
  }
}

}  // namespace

PixelRegion pixels_in_polygon(std::span<const StrokePoint> corners, int height, int width) {
  PixelRegion region;
  const auto is_finite = [](const StrokePoint& each) {
    return std::isfinite(each.y) && std::isfinite(each.x);
  };
  if (!std::ranges::all_of(corners, is_finite)) {
    throw InvalidInput("a corner of a polygon is not finite");
  }
  if (corners.size() < 3) return region;
  const auto [top, bottom] = std::ranges::minmax(corners, {}, &StrokePoint::y);
  const int y0 = first_at(top.y, height);
  const int y1 = first_at(bottom.y, height);
  for (int y = y0; y < y1; ++y) add_row(y, width, crossings_at(y + 0.5, corners), region);
  return region;
}

}  // namespace episcope
