// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// For kernel sources only: colour of a surface before it is lit.

#include "engine/scenes/cast/intersect.h"
#include "engine/scenes/cast/value_noise.h"

namespace episcope::scenes::EPISCOPE_KERNEL_NAMESPACE {
namespace {

/// Points of one primitive, in its own frame.
struct SurfacePoints {
  Floats position[3];
  Floats normal[3];  ///< Of length 1, towards the centre view.
  Floats from_center_view[3];
  Floats depth;
};

inline Floats clamp_unit(const Floats& a) {
  return least(greatest(a, Floats(0.0F)), Floats(1.0F));
}

inline Floats smooth(const Floats& t) {
  return t * t * (Floats(3.0F) - t * 2.0F);
}

inline Floats dot(const Floats* a, const Floats* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Floats dot(const double* a, const Floats* b) {
  return b[0] * static_cast<float>(a[0]) + b[1] * static_cast<float>(a[1]) +
         b[2] * static_cast<float>(a[2]);
}

inline void revolution_normal(const Primitive& primitive, const Floats* p, Floats* n) {
  n[0] = p[0];
  n[1] = Floats(static_cast<float>(-0.5 * primitive.profile[1])) -
         p[1] * static_cast<float>(primitive.profile[2]);
  n[2] = p[2];
}

/// The side whose plane is nearest to the point, in units of the extent.
inline void box_normal(const Primitive& primitive, const Floats* p, Floats* n) {
  Floats share[3];
  for (int i = 0; i < 3; ++i)
    share[i] = absolute(p[i]) * static_cast<float>(1 / primitive.extent[i]);
  const Floats most = greatest(share[0], greatest(share[1], share[2]));
  for (int i = 0; i < 3; ++i) n[i] = choose(share[i] >= most, p[i], Floats(0.0F));
}

inline SurfacePoints surface_points(const Frame<float>& frame, const LocalRays<float>& rays,
                                    const Floats& depth) {
  const Primitive& primitive = *frame.primitive;
  SurfacePoints points;
  points.depth = depth;
  const Floats t = depth - rays.start_depth;
  for (int i = 0; i < 3; ++i) {
    points.position[i] = along(rays, i, t);
    points.from_center_view[i] = points.position[i] + frame.center[i];
    points.normal[i] = Floats(i == 2 ? 1.0F : 0.0F);
  }
  if (primitive.shape == Shape::Revolution) {
    revolution_normal(primitive, points.position, points.normal);
  } else if (primitive.shape == Shape::Box) {
    box_normal(primitive, points.position, points.normal);
  }
  Floats scale = 1.0F / square_root(greatest(dot(points.normal, points.normal), Floats(1e-20F)));
  scale = choose(dot(points.normal, points.from_center_view) > 0.0F, -scale, scale);
  for (Floats& n : points.normal) n = n * scale;
  return points;
}

/// Pixels of the centre view that one unit of length on the surface covers in its foreshortened
/// direction.
inline Floats projected_unit(const SurfacePoints& points, double focal_px) {
  const Floats& x = points.from_center_view[0];
  const Floats& y = points.from_center_view[1];
  const Floats& z = points.from_center_view[2];
  const Floats facing = -dot(points.normal, points.from_center_view);
  return facing * static_cast<float>(focal_px) /
         (square_root(x * x + y * y + z * z) * points.depth);
}

inline Floats octave(const Texture& texture, const Floats* p, int index) {
  // Each octave has its lattice turned against the others and against the picture (3-4-5 triangles,
  // exact rotations), so that lattice points, where the noise is flat, do not fall together.
  static constexpr float kTurn[3][2] = {{0.8F, 0.6F}, {0.28F, 0.96F}, {0.96F, -0.28F}};
  const float c = kTurn[index][0];
  const float s = kTurn[index][1];
  Floats q[3];
  for (int i = 0; i < 3; ++i) {
    q[i] = p[i] * static_cast<float>(1 / (texture.spacing[index] * texture.stretch[i]));
  }
  const unsigned seed = texture.seed * 0x27D4EB2FU + static_cast<unsigned>(index) * 0x165667B1U;
  const Floats x = q[0] * c - q[1] * s + 0.37F;
  const Floats y = q[0] * s + q[1] * c + 0.61F;
  if (!texture.is_solid) return noise(x, y, seed);
  return noise(x, y * c - q[2] * s, y * s + q[2] * c, seed);
}

/// 0 … 1 … 0 over one period of `phase`, with softened steps.
inline Floats wave(const Floats& phase, float sharpness) {
  const Floats t = phase - convert<float>(floor_to_int(phase));
  const Floats triangle = absolute(t * 2.0F - 1.0F);
  return smooth(clamp_unit((triangle - 0.5F) * sharpness + 0.5F));
}

/// Length in pixels of the centre view over which the pattern steps along one of its axes.
inline Floats step_length_px(const Texture& texture, int axis, const SurfacePoints& points,
                             double focal_px) {
  // Image gradient of a·p on a surface of normal n seen along e: a − n (a·e)/(n·e).
  const double* a = texture.pattern_axis[axis];
  const auto size = static_cast<float>(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  const Floats ratio = dot(a, points.from_center_view) /
                       least(dot(points.normal, points.from_center_view), Floats(-1e-6F));
  Floats gradient[3];
  for (int i = 0; i < 3; ++i) {
    gradient[i] = Floats(static_cast<float>(a[i])) - points.normal[i] * ratio;
  }
  const Floats share = square_root(dot(gradient, gradient) / size);
  return Floats(static_cast<float>(texture.pattern_step * focal_px)) /
         greatest(share * points.depth, Floats(1e-6F));
}

/// The wave along one axis, fading to its mean where it would not be resolved.
inline Floats axis_wave(const Texture& texture, int axis, const SurfacePoints& points,
                        const Floats& warp, double focal_px) {
  const Floats plain =
      wave(dot(texture.pattern_axis[axis], points.position) + warp, texture.pattern_sharpness);
  if (!texture.fades) return plain;
  const Floats resolved = step_length_px(texture, axis, points, focal_px) - 1.5F;
  return (plain - 0.5F) * smooth(clamp_unit(resolved)) + 0.5F;
}

/// Share of the second colour.
inline Floats pattern_value(const Texture& texture, const SurfacePoints& points, const Floats& bend,
                            double focal_px) {
  const Floats warp = bend * texture.pattern_warp;
  switch (texture.pattern) {
    case Pattern::Plain:
      return Floats(0.0F);
    case Pattern::Stripes:
      return axis_wave(texture, 0, points, warp, focal_px);
    case Pattern::Checker: {
      const Floats s = axis_wave(texture, 0, points, warp, focal_px);
      const Floats t = axis_wave(texture, 1, points, warp, focal_px);
      return s + t - 2.0F * s * t;
    }
    case Pattern::Rings:
      break;
  }
  const Floats a = dot(texture.pattern_axis[0], points.position);
  const Floats b = dot(texture.pattern_axis[1], points.position);
  return wave(square_root(a * a + b * b) + warp, texture.pattern_sharpness);
}

/// Colour of every point, without light.
inline void albedo(const Texture& texture, const SurfacePoints& points, double focal_px,
                   Floats* rgb) {
  Floats octaves[3];
  Floats unit(0.0F);
  if (texture.fades) {
    const double* stretch = texture.stretch;
    double least = stretch[0] < stretch[1] ? stretch[0] : stretch[1];
    if (texture.is_solid && stretch[2] < least) least = stretch[2];
    unit = projected_unit(points, focal_px) * static_cast<float>(least);
  }
  for (int o = 0; o < 3; ++o) {
    if (texture.gain[o][0] == 0 && texture.gain[o][1] == 0 && texture.gain[o][2] == 0) {
      octaves[o] = Floats(0.0F);
      continue;
    }
    octaves[o] = octave(texture, points.position, o);
    if (texture.fades) {
      const Floats spacing_px = unit * static_cast<float>(texture.spacing[o]);
      octaves[o] = octaves[o] * smooth(clamp_unit(spacing_px - 3.5F));
    }
  }
  const Floats pattern = pattern_value(texture, points, octaves[2], focal_px);
  for (int c = 0; c < 3; ++c) {
    rgb[c] = Floats(texture.color[0][c]) + pattern * (texture.color[1][c] - texture.color[0][c]);
    for (int o = 0; o < 3; ++o) rgb[c] = rgb[c] + octaves[o] * texture.gain[o][c];
    rgb[c] = clamp_unit(rgb[c]);
  }
}

}  // namespace
}  // namespace episcope::scenes::EPISCOPE_KERNEL_NAMESPACE
