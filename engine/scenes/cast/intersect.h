// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// For kernel sources only: closed-form intersections of rays with primitives, in float for colour
// samples and in double for the truth.

#include "engine/core/parallel/simd_pack.h"
#include "engine/scenes/cast/model.h"

namespace episcope::scenes::EPISCOPE_KERNEL_NAMESPACE {
namespace {

using namespace episcope::EPISCOPE_KERNEL_NAMESPACE;

/// Depth of a ray that hits nothing.
constexpr float kMiss = 1e30F;

/// Whether all of a shape lies in z = 0.
constexpr bool is_flat(Shape shape) {
  return shape != Shape::Box && shape != Shape::Revolution;
}

template <class R>
struct Rays {
  Pack<R> dx;  ///< Directions (dx, dy, 1).
  Pack<R> dy;
};

/// A primitive as seen from one view: its frame in the precision of the rays.
template <class R>
struct Frame {
  const Primitive* primitive;
  R axes[3][3];
  R center[3];  ///< Of the primitive, turned into its own frame.
  R offset[3];  ///< Of the view from the centre, likewise.
  R start_depth;
};

template <class R>
inline Frame<R> frame_of(const Primitive& primitive, const ViewCamera& camera) {
  Frame<R> frame;
  frame.primitive = &primitive;
  frame.start_depth = static_cast<R>(primitive.center[2]);
  for (int i = 0; i < 3; ++i) {
    double center = 0;
    double offset = 0;
    for (int k = 0; k < 3; ++k) {
      const double axis = primitive.axes[i][k];
      frame.axes[i][k] = static_cast<R>(axis);
      center += axis * primitive.center[k];
      offset += axis * (camera.origin[k] - primitive.center[k]);
    }
    frame.center[i] = static_cast<R>(center);
    frame.offset[i] = static_cast<R>(offset);
  }
  return frame;
}

/// Rays in the frame of a primitive; they begin at the depth of its centre, so that numbers stay of
/// the size of the object and precision is not lost far from the camera.
template <class R>
struct LocalRays {
  Pack<R> start[3];
  Pack<R> direction[3];
  R start_depth;
};

template <class R>
inline LocalRays<R> to_local(const Frame<R>& frame, const Rays<R>& rays) {
  LocalRays<R> local;
  local.start_depth = frame.start_depth;
  for (int i = 0; i < 3; ++i) {
    const R* axis = frame.axes[i];
    local.direction[i] = rays.dx * axis[0] + rays.dy * axis[1] + axis[2];
    local.start[i] = local.direction[i] * frame.start_depth + frame.offset[i];
  }
  return local;
}

template <class R>
inline Pack<R> along(const LocalRays<R>& rays, int axis, const Pack<R>& t) {
  return rays.start[axis] + t * rays.direction[axis];
}

/// Distance to the nearest multiple of `pitch`.
template <class R>
inline Pack<R> from_multiple(const Pack<R>& x, R pitch) {
  // Adding 1.5 times the first number that has no fraction, and taking it away, rounds.
  const R no_fraction = sizeof(R) == 4 ? R(12582912) : R(6755399441055744);
  const Pack<R> multiple = (x * (R(1) / pitch) + no_fraction) - no_fraction;
  return absolute(x - multiple * pitch);
}

/// Whether a flat primitive has material at (x, y).
template <class R>
inline Mask<R> covers_point(const Primitive& primitive, const Pack<R>& x, const Pack<R>& y) {
  const auto extent_x = static_cast<R>(primitive.extent[0]);
  const auto extent_y = static_cast<R>(primitive.extent[1]);
  if (primitive.shape == Shape::Disc) return x * x + y * y <= extent_x * extent_x;
  if (primitive.shape == Shape::Leaf) {
    const Pack<R> share = x * (R(1) / extent_x);
    return absolute(y) <= (R(1) - share * share) * extent_y;
  }
  if (primitive.shape == Shape::Triangle) {
    const Pack<R> half_width = (extent_x - x) * (extent_y / (R(2) * extent_x));
    return (absolute(x) <= extent_x) & (absolute(y) <= half_width);
  }
  const Mask<R> inside = (absolute(x) <= extent_x) & (absolute(y) <= extent_y);
  if (primitive.shape != Shape::Lattice) return inside;
  const auto upright = static_cast<R>(primitive.profile[2]);
  const auto level = static_cast<R>(primitive.extent[2]);
  return inside & ((from_multiple(x, static_cast<R>(primitive.profile[0])) <= upright) |
                   (from_multiple(y, static_cast<R>(primitive.profile[1])) <= level));
}

/// Each returns t from the start of the local rays, or kMiss.
template <class R>
inline Pack<R> hit_plane(const Primitive& primitive, const LocalRays<R>& rays) {
  const Pack<R> t = -rays.start[2] / rays.direction[2];
  const Pack<R> x = along(rays, 0, t);
  const Pack<R> y = along(rays, 1, t);
  return choose(covers_point(primitive, x, y), t, Pack<R>(R(kMiss)));
}

template <class R>
inline Pack<R> hit_box(const Primitive& primitive, const LocalRays<R>& rays) {
  Pack<R> near_t(R(-kMiss));
  Pack<R> far_t{R(kMiss)};
  for (int i = 0; i < 3; ++i) {
    const auto extent = static_cast<R>(primitive.extent[i]);
    const Pack<R> inverse = R(1) / rays.direction[i];
    const Pack<R> a = (Pack<R>(-extent) - rays.start[i]) * inverse;
    const Pack<R> b = (Pack<R>(extent) - rays.start[i]) * inverse;
    near_t = greatest(near_t, least(a, b));
    far_t = least(far_t, greatest(a, b));
  }
  return choose(near_t <= far_t, near_t, Pack<R>(R(kMiss)));
}

template <class R>
inline Pack<R> hit_revolution(const Primitive& primitive, const LocalRays<R>& rays) {
  const auto p0 = static_cast<R>(primitive.profile[0]);
  const auto p1 = static_cast<R>(primitive.profile[1]);
  const auto p2 = static_cast<R>(primitive.profile[2]);
  const auto& s = rays.start;
  const auto& d = rays.direction;
  // a t² + 2 b t + c = 0
  const Pack<R> a = d[0] * d[0] + d[2] * d[2] - d[1] * d[1] * p2;
  const Pack<R> b = s[0] * d[0] + s[2] * d[2] - d[1] * (s[1] * p2 + p1 / R(2));
  const Pack<R> c = s[0] * s[0] + s[2] * s[2] - (s[1] * (s[1] * p2 + p1) + p0);
  const Pack<R> discriminant = b * b - a * c;
  const Mask<R> is_real = discriminant >= R(0);
  if (!any(is_real)) return Pack<R>(R(kMiss));
  const Pack<R> r = square_root(greatest(discriminant, Pack<R>(R(0))));
  const Pack<R> one = (-b - r) / a;
  const Pack<R> two = (r - b) / a;
  const auto low = static_cast<R>(primitive.extent[0]);
  const auto high = static_cast<R>(primitive.extent[1]);
  const auto within = [&](const Pack<R>& t) {
    const Pack<R> y = along(rays, 1, t);
    return choose((y >= low) & (y <= high) & is_real, t, Pack<R>(R(kMiss)));
  };
  return least(within(one), within(two));
}

/// Depth of the nearest hit in front of the camera, or kMiss.
template <class R>
inline Pack<R> hit_depth(const Primitive& primitive, const LocalRays<R>& rays) {
  Pack<R> t;
  switch (primitive.shape) {
    case Shape::Rectangle:
    case Shape::Disc:
    case Shape::Leaf:
    case Shape::Triangle:
    case Shape::Lattice:
      t = hit_plane(primitive, rays);
      break;
    case Shape::Box:
      t = hit_box(primitive, rays);
      break;
    case Shape::Revolution:
      t = hit_revolution(primitive, rays);
      break;
  }
  const Pack<R> depth = t + rays.start_depth;
  return choose(depth > R(0), depth, Pack<R>(R(kMiss)));
}

}  // namespace
}  // namespace episcope::scenes::EPISCOPE_KERNEL_NAMESPACE
