// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/depth/screen_triangle.h"

#include <cstdint>
#include <span>
#include <vector>

namespace episcope::capture {

/// The part of a triangle in a pixel.
struct Fragment {
  std::uint32_t triangle = 0;
  float area = 0;  ///< Share of the pixel, whether hidden or not.
  float near = 0;  ///< Largest 1/Z in the pixel,
  float far = 0;   ///< and the smallest.
  std::uint16_t pixel = 0;
  bool is_front = false;
};

/// What a pixel shows of a triangle, exactly.
struct VisiblePart {
  int index = 0;          ///< Of the triangle in the list.
  double area = 0;        ///< That is seen, in px².
  Corner centroid{0, 0};  ///< Of the seen part.
};

/// What is seen of each of the triangles around a pixel: each minus all that lies in front of it,
/// point by point, also of those that pierce each other. Of coinciding triangles the first is seen.
/// Triangles without a visible part are left out. Cubic in their number at worst.
/// Source: [WMG13] section 3.2.1 ("the polygon with the biggest area inside the pixel").
[[nodiscard]] std::vector<VisiblePart> visible_parts(std::span<const ScreenTriangle> triangles);

/// What decides the depth of a pixel.
struct PixelSurface {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::uint32_t triangle = kNone;  ///< Of the largest visible area; of equal areas the first.
  float covered = 0;               ///< Share of the pixel that shows triangles.
  bool is_front = false;
  bool is_edge = false;  ///< It shows surfaces that lie apart: the depth jumps in it.
  InversePlane plane;    ///< Of that triangle, around the centre of the pixel.
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
  /// Sorts by nearness; returns how many fragments tile the pixel before all others, 0 if that is
  /// not so.
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

}  // namespace episcope::capture
