// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/depth/polygon.h"

#include <algorithm>
#include <cmath>

namespace episcope::capture {
namespace {

/// Areas below this share of a pixel are rounding, of edges that two polygons have in common.
constexpr double kNoArea = 1e-11;

}  // namespace

double twice_area(const Polygon& polygon) {
  double sum = 0;
  const Corner& o = polygon.corners[0];
  for (int i = 2; i < polygon.count; ++i) {
    const Corner& p = polygon.corners[i - 1];
    const Corner& q = polygon.corners[i];
    sum += (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
  }
  return sum;
}

Corner centroid(const Polygon& polygon) {
  double weight = 0;
  Corner sum{0, 0};
  const Corner& o = polygon.corners[0];
  for (int i = 2; i < polygon.count; ++i) {
    const Corner& p = polygon.corners[i - 1];
    const Corner& q = polygon.corners[i];
    const double area = (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
    weight += area;
    sum.x += area * (o.x + p.x + q.x);
    sum.y += area * (o.y + p.y + q.y);
  }
  if (weight == 0) return o;
  return {sum.x / (3 * weight), sum.y / (3 * weight)};
}

Polygon clipped(const Polygon& polygon, const HalfPlane& half) {
  Polygon part;
  if (polygon.count == 0) return part;
  Corner from = polygon.corners[polygon.count - 1];
  double from_side = half.at(from);
  for (int i = 0; i < polygon.count; ++i) {
    const Corner& to = polygon.corners[i];
    const double to_side = half.at(to);
    if ((from_side > 0 && to_side < 0) || (from_side < 0 && to_side > 0)) {
      const double t = from_side / (from_side - to_side);
      part.add({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
    }
    if (to_side >= 0) part.add(to);
    from = to;
    from_side = to_side;
  }
  if (part.count < 3) part.count = 0;
  return part;
}

Polygon clipped_to_pixel(const Polygon& polygon) {
  Polygon part = clipped(polygon, {1, 0, 0.5});
  part = clipped(part, {-1, 0, 0.5});
  part = clipped(part, {0, 1, 0.5});
  return clipped(part, {0, -1, 0.5});
}

bool edge_parts(const Polygon& a, const Polygon& b) {
  Corner p = a.corners[a.count - 1];
  for (int i = 0; i < a.count; ++i) {
    const Corner& q = a.corners[i];
    const double nx = p.y - q.y;
    const double ny = q.x - p.x;
    const double rounding = 1e-12 * (std::abs(nx) + std::abs(ny));
    bool is_outside = true;
    for (int k = 0; k < b.count && is_outside; ++k) {
      is_outside = nx * (b.corners[k].x - p.x) + ny * (b.corners[k].y - p.y) <= rounding;
    }
    if (is_outside) return true;
    p = q;
  }
  return false;
}

void subtract(const Polygon& polygon, const Polygon& hole, std::vector<Polygon>& pieces) {
  const double turn = twice_area(hole) >= 0 ? 1 : -1;
  Polygon rest = polygon;
  const std::size_t before = pieces.size();
  for (int i = 0; i < hole.count; ++i) {
    const Corner& p = hole.corners[i];
    const Corner& q = hole.corners[(i + 1) % hole.count];
    const double a = turn * (p.y - q.y);
    const double b = turn * (q.x - p.x);
    const HalfPlane inside{a, b, -a * p.x - b * p.y};
    const Polygon outside = clipped(rest, {-inside.a, -inside.b, -inside.c});
    if (std::abs(twice_area(outside)) > kNoArea) pieces.push_back(outside);
    rest = clipped(rest, inside);
    if (rest.count == 0) break;
  }
  if (rest.count == 0 || std::abs(twice_area(rest)) <= kNoArea) {  // they do not overlap
    pieces.resize(before);
    pieces.push_back(polygon);
  }
}

}  // namespace episcope::capture
