// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/simd.h"
#include "engine/scenes/stage.h"

// Value noise on an integer lattice, closed-form intersections, color of surfaces, light, and the
// row of a view that is traced by them. Compiled once for each instruction set (engine/core/isa.h).

namespace episcope::scenes::EPISCOPE_KERNEL_NAMESPACE {
namespace {

using namespace episcope::EPISCOPE_KERNEL_NAMESPACE;

constexpr unsigned kPrimeX = 0x9E3779B1U;
constexpr unsigned kPrimeY = 0x85EBCA77U;
constexpr unsigned kPrimeZ = 0xC2B2AE3DU;

/// A lattice value in [−1, 1) for each key.
inline Floats lattice_value(const Uints& key) {
  Uints h = (key ^ (key >> 15)) * 0x2C1B3C6DU;
  h = (h ^ (h >> 12)) * 0x297A2D39U;
  return convert<float>(convert<int>(h >> 8)) * 0x1p-23F - 1.0F;
}

/// The largest integers not above `a`, of magnitude below 2^31.
inline Ints floor_to_int(const Floats& a) {
  const Ints cut = convert<int>(a);
  return cut + (convert<float>(cut) > a);  // a comparison that holds is −1
}

/// Lattice cell of one coordinate: keys of its two ends and the C2 weight of the second.
struct Cell {
  Uints low;
  Uints high;
  Floats weight;
};

inline Cell cell_of(const Floats& x, unsigned prime) {
  const Ints whole = floor_to_int(x);
  const Floats t = x - convert<float>(whole);
  Cell cell;
  cell.low = convert<unsigned>(whole) * prime;
  cell.high = cell.low + prime;
  cell.weight = t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F);
  return cell;
}

inline Floats blend(const Floats& a, const Floats& b, const Floats& weight) {
  return a + (b - a) * weight;
}

inline Floats noise(const Floats& x, const Floats& y, unsigned seed) {
  const Cell cx = cell_of(x, kPrimeX);
  const Cell cy = cell_of(y, kPrimeY);
  const Uints top = cy.low ^ seed;
  const Uints bottom = cy.high ^ seed;
  return blend(blend(lattice_value(cx.low ^ top), lattice_value(cx.high ^ top), cx.weight),
               blend(lattice_value(cx.low ^ bottom), lattice_value(cx.high ^ bottom), cx.weight),
               cy.weight);
}

inline Floats noise(const Floats& x, const Floats& y, const Floats& z, unsigned seed) {
  const Cell cx = cell_of(x, kPrimeX);
  const Cell cy = cell_of(y, kPrimeY);
  const Cell cz = cell_of(z, kPrimeZ);
  const auto slice = [&](const Uints& z_key) {
    const Uints top = cy.low ^ z_key;
    const Uints bottom = cy.high ^ z_key;
    return blend(blend(lattice_value(cx.low ^ top), lattice_value(cx.high ^ top), cx.weight),
                 blend(lattice_value(cx.low ^ bottom), lattice_value(cx.high ^ bottom), cx.weight),
                 cy.weight);
  };
  return blend(slice(cz.low ^ seed), slice(cz.high ^ seed), cz.weight);
}

// Closed-form intersections of rays with primitives, in float for color
// samples and in double for the truth.

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
  R offset[3];  ///< Of the view from the center, likewise.
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

/// Rays in the frame of a primitive; they begin at the depth of its center, so that numbers stay of
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

// Color of a surface before it is lit.

/// Points of one primitive, in its own frame.
struct SurfacePoints {
  Floats position[3];
  Floats normal[3];  ///< Of length 1, towards the center view.
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

/// Pixels of the center view that one unit of length on the surface covers in its foreshortened
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

/// Length in pixels of the center view over which the pattern steps along one of its axes.
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

/// Share of the second color.
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

/// Color of every point, without light.
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

// Soft light on points of the scene. It depends on the point alone, not on
// the view, so that every surface looks the same from everywhere; highlights may move.

/// Points in the camera frame with their mean color, waiting to be lit.
struct Fragments {
  Floats position[3];
  Floats normal[3];
  Floats color[3];
  Floats gloss;
  Floats weight;  ///< Share of the pixel.
  Ints label;
  int pixel[Floats::kLanes];
  int count = 0;
};

inline Floats dot(const Floats* a, const float* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

struct Shade {
  Floats sky;  ///< Share of the sky that is seen.
  Floats key;  ///< Share of the key light that is seen.
};

/// Ambient occlusion and soft shadow of spheres.
inline Shade shade(const Fragments& f, const ModelView& model) {
  constexpr float light_width = 0.45F;
  const Floats one(1.0F);
  Shade seen{one, one};
  for (int i = 0; i < model.occluder_count; ++i) {
    const Occluder& occluder = model.occluders[i];
    const float radius = occluder.radius;
    Floats from[3];
    for (int k = 0; k < 3; ++k) from[k] = f.position[k] - occluder.center[k];
    const Floats squared = dot(from, from);
    const Floats facing = -dot(f.normal, from);
    const Floats cover = clamp_unit(facing * (radius * radius) /
                                    greatest(squared * square_root(squared), Floats(1e-9F)));

    const Floats ahead = -dot(from, model.lighting.key_direction);
    const Floats gap = square_root(greatest(squared - ahead * ahead, Floats(0.0F))) - radius;
    const Floats open =
        smooth(clamp_unit(gap / greatest(ahead * light_width, Floats(1e-6F)) + 0.5F));
    const Ints is_own = f.label == occluder.label;
    seen.sky = seen.sky * choose(is_own, one, one - cover);
    seen.key = seen.key * choose(is_own | (ahead <= 0.0F), one, open);
  }
  return seen;
}

/// A soft highlight, as seen from `eye`.
inline Floats highlight(const Fragments& f, const Lighting& lighting, const float* eye) {
  Floats half[3];
  for (int k = 0; k < 3; ++k) half[k] = f.position[k] - eye[k];
  const Floats to_view = -1.0F / square_root(dot(half, half));
  for (int k = 0; k < 3; ++k) half[k] = half[k] * to_view + lighting.key_direction[k];
  Floats power = greatest(dot(f.normal, half), Floats(0.0F)) / square_root(dot(half, half));
  for (int i = 0; i < 5; ++i) power = power * power;
  return power;
}

/// Lights all fragments and adds them to the row.
inline void flush(Fragments& f, const ModelView& model, const ViewCamera& camera, float* row) {
  if (f.count == 0) return;
  for (int lane = f.count; lane < Floats::kLanes; ++lane) f.weight[lane] = 0.0F;
  Floats light[3] = {1.0F, 1.0F, 1.0F};
  Floats glint(0.0F);
  const Lighting& lighting = model.lighting;
  if (lighting.is_on) {
    const Shade seen = shade(f, model);
    const Floats key = greatest(dot(f.normal, lighting.key_direction), Floats(0.0F)) * seen.key;
    const Floats up = dot(f.normal, lighting.up) * 0.5F + 0.5F;
    for (int c = 0; c < 3; ++c) {
      const Floats sky = Floats(lighting.ground[c]) + up * (lighting.sky[c] - lighting.ground[c]);
      light[c] = sky * seen.sky + key * lighting.key[c];
    }
    float eye[3] = {};  // Of the center view.
    if (lighting.has_moving_highlights) {
      for (int k = 0; k < 3; ++k) eye[k] = static_cast<float>(camera.origin[k]);
    }
    glint = highlight(f, lighting, eye) * f.gloss * seen.key;
  }
  for (int c = 0; c < 3; ++c) {
    const Floats lit = (f.color[c] * light[c] + glint) * f.weight;
    for (int lane = 0; lane < f.count; ++lane) row[f.pixel[lane] * 3 + c] += lit[lane];
  }
  f.count = 0;
}

constexpr int kSamples = 16;
constexpr int kCenters = Doubles::kLanes;
constexpr double kNoHit = 0.5 * kMiss;

bool covers(const Candidate& candidate, int begin, int end) {
  return candidate.begin < end && candidate.end > begin;
}

// The sum of all lanes, in the same order on every instruction set.
float sum(const Floats& a) {
  float lanes[Floats::kLanes];
  store(lanes, a);
  for (int half = Floats::kLanes / 2; half > 0; half /= 2) {
    for (int i = 0; i < half; ++i) lanes[i] += lanes[i + half];
  }
  return lanes[0];
}

template <class R>
struct Nearest {
  Pack<R> depth = Pack<R>(R(kMiss));
  Pack<R> primitive = Pack<R>(R(-1));

  void offer(const Pack<R>& other, int index) {
    const auto nearer = other < depth;
    depth = choose(nearer, other, depth);
    primitive = choose(nearer, Pack<R>(static_cast<R>(index)), primitive);
  }
};

// One row in progress.
struct Row {
  const RowJob& job;
  const RowResult& out;
  Frame<double> centers[kMaxCandidates];
  Frame<float> samples[kMaxCandidates];
  Fragments fragments{};

  Row(const RowJob& row_job, const RowResult& result) : job(row_job), out(result) {
    for (int i = 0; i < job.candidate_count; ++i) {
      const Primitive& primitive = job.model.primitives[job.candidates[i].primitive];
      centers[i] = frame_of<double>(primitive, job.camera);
      samples[i] = frame_of<float>(primitive, job.camera);
    }
  }

  void trace_centers(int x0) const;
  void trace_samples(int x);
  void add_fragment(const Frame<float>& frame, const Rays<float>& rays, int x, const Floats& depth,
                    const Floats& weight);
  [[nodiscard]] Rays<float> sample_rays(int x) const;
  // Direction through pixel `at` along an axis.
  [[nodiscard]] float center_slope(int at, int axis) const {
    return static_cast<float>((at - job.camera.principal[axis]) / job.camera.focal_px);
  }
};

void Row::trace_centers(int x0) const {
  const ViewCamera& camera = job.camera;
  Rays<double> rays;
  for (int i = 0; i < kCenters; ++i) rays.dx[i] = x0 + i - camera.principal[0];
  rays.dx = rays.dx / camera.focal_px;
  rays.dy = Doubles((job.y - camera.principal[1]) / camera.focal_px);
  Nearest<double> solid;
  Nearest<double> pane;
  for (int i = 0; i < job.candidate_count; ++i) {
    if (!covers(job.candidates[i], x0, x0 + kCenters)) continue;
    const Primitive& primitive = *centers[i].primitive;
    const Doubles depth = hit_depth(primitive, to_local(centers[i], rays));
    (primitive.is_pane ? pane : solid).offer(depth, job.candidates[i].primitive);
  }
  for (int i = 0; i < kCenters; ++i) {
    out.primitive[x0 + i] = solid.depth[i] < kNoHit ? static_cast<int>(solid.primitive[i]) : -1;
    out.depth[x0 + i] = solid.depth[i];
    const bool has_pane = pane.depth[i] < kNoHit && pane.depth[i] < solid.depth[i];
    out.pane[x0 + i] = has_pane ? static_cast<int>(pane.primitive[i]) : -1;
    out.pane_depth[x0 + i] = pane.depth[i];
  }
}

// Adds the samples of one primitive in one pixel as a fragment.
void Row::add_fragment(const Frame<float>& frame, const Rays<float>& rays, int x,
                       const Floats& depth, const Floats& weight) {
  const Primitive& primitive = *frame.primitive;
  const Texture& texture = job.model.textures[primitive.texture];
  const SurfacePoints points = surface_points(frame, to_local(frame, rays), depth);
  Floats rgb[3];
  albedo(texture, points, job.camera.focal_px, rgb);

  const int slot = fragments.count++;
  const float total = sum(weight);
  const float scale = 1 / total;
  fragments.pixel[slot] = x;
  fragments.weight[slot] = total / kSamples;
  for (int c = 0; c < 3; ++c) fragments.color[c][slot] = sum(rgb[c] * weight) * scale;
  if (!job.model.lighting.is_on) return;
  fragments.label[slot] = primitive.label;
  fragments.gloss[slot] = texture.gloss;
  const bool has_one_normal = is_flat(primitive.shape);
  float normal[3];
  for (int i = 0; i < 3; ++i) {
    normal[i] = has_one_normal ? points.normal[i][0] : sum(points.normal[i] * weight) * scale;
  }
  const float mean_depth = sum(depth * weight) * scale;
  const bool is_whole = total == static_cast<float>(kSamples);
  const float slope[3] = {is_whole ? center_slope(x, 0) : sum(rays.dx * weight) * scale,
                          is_whole ? center_slope(job.y, 1) : sum(rays.dy * weight) * scale, 1};
  for (int k = 0; k < 3; ++k) {
    const auto origin = static_cast<float>(job.camera.origin[k]);
    fragments.position[k][slot] = origin + mean_depth * slope[k];
    float world = 0;
    for (int i = 0; i < 3; ++i) world += frame.axes[i][k] * normal[i];
    fragments.normal[k][slot] = world;
  }
}

Rays<float> Row::sample_rays(int x) const {
  Rays<float> rays;
  for (int i = 0; i < kSamples; ++i) {
    rays.dx[i] = static_cast<float>(i % 4) * 0.25F - 0.375F;
    rays.dy[i] = static_cast<float>(i / 4) * 0.25F - 0.375F;
  }
  const auto pixel = static_cast<float>(job.fill / job.camera.focal_px);
  rays.dx = rays.dx * pixel + center_slope(x, 0);
  rays.dy = rays.dy * pixel + center_slope(job.y, 1);
  return rays;
}

void Row::trace_samples(int x) {
  const Rays<float> rays = sample_rays(x);
  Nearest<float> solid;
  Nearest<float> pane;
  for (int i = 0; i < job.candidate_count; ++i) {
    if (!covers(job.candidates[i], x, x + 1)) continue;
    const Primitive& primitive = *samples[i].primitive;
    const Floats depth = hit_depth(primitive, to_local(samples[i], rays));
    (primitive.is_pane ? pane : solid).offer(depth, i);
  }
  const Ints behind_pane = pane.depth < solid.depth;
  const Floats zero(0.0F);
  const Floats solid_weight = choose(behind_pane, Floats(0.5F), Floats(1.0F));
  const Floats pane_weight = choose(behind_pane, Floats(0.5F), zero);
  int label = 0;
  for (int i = 0; i < job.candidate_count; ++i) {
    if (!covers(job.candidates[i], x, x + 1)) continue;
    const Primitive& primitive = *samples[i].primitive;
    const Nearest<float>& hits = primitive.is_pane ? pane : solid;
    Ints hit = convert<int>(hits.primitive) == i;
    if (primitive.is_pane) hit = hit & behind_pane;
    if (!any(hit)) continue;
    if (fragments.count == Floats::kLanes) flush(fragments, job.model, job.camera, out.color);
    add_fragment(samples[i], rays, x, choose(hit, hits.depth, Floats(1.0F)),
                 choose(hit, primitive.is_pane ? pane_weight : solid_weight, zero));
    if (label != 0 && label != primitive.label && !primitive.is_pane) out.is_edge[x] = 1;
    if (!primitive.is_pane) label = primitive.label;
  }
}

}  // namespace

void trace_row(const RowJob& job, const RowResult& out) {
  for (int i = 0; i < job.width; ++i) out.is_edge[i] = 0;
  for (int i = 0; i < 3 * job.width; ++i) out.color[i] = 0;
  Row row(job, out);
  for (int x = 0; x < job.width; x += kCenters) row.trace_centers(x);
  for (int x = 0; x < job.width; ++x) row.trace_samples(x);
  flush(row.fragments, job.model, job.camera, out.color);
}

}  // namespace episcope::scenes::EPISCOPE_KERNEL_NAMESPACE
