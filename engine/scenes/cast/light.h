// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// For kernel sources only: soft light on points of the scene. It depends on the point alone, not on
// the view, so that every surface looks the same from everywhere; highlights may move.

#include "engine/scenes/cast/surface.h"

namespace episcope::scenes::EPISCOPE_KERNEL_NAMESPACE {
namespace {

/// Points in the camera frame with their mean colour, waiting to be lit.
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
    float eye[3] = {};  // Of the centre view.
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

}  // namespace
}  // namespace episcope::scenes::EPISCOPE_KERNEL_NAMESPACE
