// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera.h"
#include "engine/core/image.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace episcope::capture {

/// A point of the image plane, in px.
struct Corner {
  double x;
  double y;
};

/// The half-plane a·x + b·y + c ≥ 0.
struct HalfPlane {
  double a = 0;
  double b = 0;
  double c = 0;
  [[nodiscard]] double at(const Corner& p) const { return a * p.x + b * p.y + c; }
};

/// A convex polygon, of either orientation, without memory of its own.
struct Polygon {
  static constexpr int kMost = 24;    ///< Corners: a triangle cut by a square has at most 7.
  std::array<Corner, kMost> corners;  ///< The first `count`; others are not initialized.
  int count = 0;

  void add(const Corner& corner) {
    if (count < kMost) corners[count++] = corner;
  }
};

/// Twice the signed area, from the first corner.
[[nodiscard]] double twice_area(const Polygon& polygon);
/// The centroid; of a polygon without area its first corner. Precondition: not empty.
[[nodiscard]] Corner centroid(const Polygon& polygon);
/// The part in the half-plane (Sutherland and Hodgman); empty if there is none.
[[nodiscard]] Polygon clipped(const Polygon& polygon, const HalfPlane& half);
/// The part in the square of a pixel around (0, 0).
[[nodiscard]] Polygon clipped_to_pixel(const Polygon& polygon);

/// Appends to `pieces` the convex parts of `polygon` outside of the convex `hole`.
void subtract(const Polygon& polygon, const Polygon& hole, std::vector<Polygon>& pieces);

/// A vertex as a view sees it: place in px, and 1/Z, which is affine in the place on every plane.
struct ScreenVertex {
  float x = 0;
  float y = 0;
  float w = 0;  ///< 1/Z, > 0; 0 = not in front of the camera.
};

/// A plane in space as a view sees it: 1/Z at (x, y).
struct InversePlane {
  double by_x = 0;
  double by_y = 0;
  double at_zero = 0;
  [[nodiscard]] double at(const Corner& p) const { return by_x * p.x + by_y * p.y + at_zero; }
};

/// A triangle around a pixel: places relative to the center of the pixel.
struct ScreenTriangle {
  Polygon polygon;
  InversePlane plane;
  bool is_front = false;  ///< Seen from outside.
};

/// Twice the signed area; below 0 = seen from outside, since y grows downwards.
[[nodiscard]] inline double turn_of(const std::array<ScreenVertex, 3>& v) {
  return (static_cast<double>(v[1].x) - v[0].x) * (static_cast<double>(v[2].y) - v[0].y) -
         (static_cast<double>(v[2].x) - v[0].x) * (static_cast<double>(v[1].y) - v[0].y);
}

/// The triangle around pixel (x, y). Precondition: `turn_of(v)` is not 0.
[[nodiscard]] inline ScreenTriangle around_pixel(const std::array<ScreenVertex, 3>& v, int x,
                                                 int y) {
  ScreenTriangle triangle;
  for (const ScreenVertex& vertex : v) {
    triangle.polygon.add({static_cast<double>(vertex.x) - x, static_cast<double>(vertex.y) - y});
  }
  const auto& c = triangle.polygon.corners;
  const double turn = turn_of(v);
  const double w1 = static_cast<double>(v[1].w) - v[0].w;
  const double w2 = static_cast<double>(v[2].w) - v[0].w;
  InversePlane& plane = triangle.plane;
  plane.by_x = (w1 * (c[2].y - c[0].y) - w2 * (c[1].y - c[0].y)) / turn;
  plane.by_y = (w2 * (c[1].x - c[0].x) - w1 * (c[2].x - c[0].x)) / turn;
  plane.at_zero = v[0].w - plane.by_x * c[0].x - plane.by_y * c[0].y;
  triangle.is_front = turn < 0;
  return triangle;
}

struct Fragment {
  std::uint32_t triangle = 0;
  float area = 0;  ///< Share of the pixel, whether hidden or not.
  float near = 0;  ///< Largest 1/Z in the pixel,
  float far = 0;   ///< and the smallest.
  std::uint16_t pixel = 0;
  bool is_front = false;
};

/// Visible part of a triangle within a pixel, exact.
struct VisiblePart {
  int index = 0;    ///< Of the triangle in the list.
  double area = 0;  ///< In px².
  Corner centroid{0, 0};
};

/// Visible parts of the triangles around a pixel: each minus everything in front of it, point by
/// point, also for triangles that pierce each other. The first of coinciding triangles is visible.
/// Triangles without a visible part are left out. Cubic in their number at worst.
/// Source: [WMG13] section 3.2.1 ("the polygon with the biggest area inside the pixel").
[[nodiscard]] std::vector<VisiblePart> visible_parts(std::span<const ScreenTriangle> triangles);

/// The surface that decides the depth of a pixel.
struct PixelSurface {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::uint32_t triangle = kNone;  ///< Of the largest visible area; of equal areas the first.
  float covered = 0;               ///< Share of the pixel that shows triangles.
  bool is_front = false;
  bool is_edge = false;  ///< It shows surfaces that lie apart: the depth jumps in it.
  InversePlane plane;    ///< Of that triangle, around the center of the pixel.
};

/// Resolves pixels. `triangle_at(id)` gives a triangle around the pixel.
class PixelResolver {
 public:
  /// `jump`: least difference of 1/Z between surfaces that lie apart.
  explicit PixelResolver(double jump) : jump_(jump) {}

  template <class TriangleAt>
  [[nodiscard]] PixelSurface resolve(std::span<Fragment> fragments, const TriangleAt& triangle_at) {
    const std::size_t front = order(fragments);
    triangles_.clear();
    const bool is_plain = front > 0 && !spreads(fragments.first(front));
    if (is_plain) return plain(fragments.first(front), triangle_at);
    for (const Fragment& f : fragments.first(reach(fragments, front))) {
      triangles_.push_back(triangle_at(f.triangle));
    }
    return exact(fragments);
  }

 private:
  /// Sorts by nearness; returns how many fragments tile the pixel before all others, 0 if none do.
  [[nodiscard]] static std::size_t order(std::span<Fragment> fragments);
  /// How many fragments may be seen: all, or those that tile it.
  [[nodiscard]] static std::size_t reach(std::span<const Fragment> fragments, std::size_t front) {
    return front > 0 ? front : fragments.size();
  }
  [[nodiscard]] bool spreads(std::span<const Fragment> fragments) const;
  [[nodiscard]] PixelSurface exact(std::span<const Fragment> fragments) const;
  template <class TriangleAt>
  [[nodiscard]] PixelSurface plain(std::span<const Fragment> fragments,
                                   const TriangleAt& triangle_at) const {
    const Fragment* best = fragments.data();
    for (const Fragment& f : fragments) {
      const bool wins =
          f.area > best->area || (f.area == best->area && f.triangle < best->triangle);
      if (wins) best = &f;
    }
    return {best->triangle, 1, best->is_front, false, triangle_at(best->triangle).plane};
  }

  double jump_;
  std::vector<ScreenTriangle> triangles_;
};

enum class MarkKind { Corner, Blob };

/// A mark found near a pick.
struct SnappedPick {
  PlanePoint place;  ///< px, centers of pixels have whole coordinates.
  MarkKind kind = MarkKind::Corner;
};

/// The corner, or the center of the blob or ring, within `reach_px` of `pick`, to a fraction of a
/// pixel: where lines along the edges meet, or lines along the gradients, whichever fits better
/// under a Gaussian window of σ = reach_px / 2 that follows the point.
/// `gray` in units of 1/255. Nothing if no such point stays within reach, for lack of structure in
/// two directions, or with contrast no larger than noise (gradients under 3 units/px RMS).
/// Source: Förstner and Gülch, A fast operator for detection and precise location of distinct
/// points, corners and centers of circular features, 1987.
[[nodiscard]] std::optional<SnappedPick> snap_pick(ImageView<const float> gray,
                                                   const PlanePoint& pick, double reach_px);

}  // namespace episcope::capture
