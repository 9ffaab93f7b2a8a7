// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/random/materials.h"

#include <algorithm>

namespace episcope::scenes {
namespace {

// From nearly grey to strong.
std::array<float, 3> draw_color(Draw& draw) {
  const double brightness = draw.between(0.28, 0.72);
  const double strength = draw.between(0.03, 0.3);
  std::array<float, 3> color{};
  for (float& channel : color) {
    const double offset = draw.between(-1, 1);
    channel = static_cast<float>(std::clamp(brightness + strength * offset, 0.12, 0.88));
  }
  return color;
}

void set_second_color(Texture& texture, Draw& draw, double contrast) {
  const double lighter = draw.sign();
  for (int c = 0; c < 3; ++c) {
    const double step = lighter * contrast * draw.between(0.15, 0.5);
    texture.color[1][c] = static_cast<float>(std::clamp(texture.color[0][c] + step, 0.06, 0.94));
  }
}

Vector3 draw_direction(Draw& draw) {
  Vector3 direction{};
  for (double& part : direction) part = draw.between(-1, 1);
  direction[1] += 1.2 * draw.sign();  // Never of length 0.
  return normalized(direction);
}

void add_random_pattern(Texture& texture, Draw& draw, double pixel_units, const Detail& detail) {
  constexpr Pattern patterns[] = {Pattern::Stripes, Pattern::Checker, Pattern::Rings};
  const Pattern pattern = patterns[draw.weighted(std::array<double, 3>{0.5, 0.35, 0.15})];
  const double period_px = 6.5 + 26 * draw.small();
  const Vector3 along = draw_direction(draw);
  const Vector3 across = normalized(cross(along, {0.31, 0.17, 0.93}));
  set_pattern(texture, pattern, detail.size * pixel_units, period_px * pixel_units,
              {along, across});
  if (draw.chance(0.3)) texture.pattern_warp = static_cast<float>(draw.between(0.05, 0.4));
  set_second_color(texture, draw, detail.contrast);
}

Texture draw_noise(Draw& draw, double pixel_units, double contrast, double size) {
  // Fine grain on half of the surfaces, coarser on the others.
  const double coarseness = draw.chance(0.6) ? 1 : draw.between(1, 2.5);
  const unsigned seed = draw.bits();
  const std::array<float, 3> color = draw_color(draw);
  Texture texture =
      noise_texture(coarseness * size * pixel_units, seed, color, static_cast<float>(contrast));
  if (draw.chance(0.25)) texture.stretch[draw.integer(0, 2)] = draw.between(1.5, 4);
  texture.fades = size >= 1;
  texture.is_solid = true;
  return texture;
}

}  // namespace

Texture draw_texture(Draw draw, Finish finish, double pixel_units, const Detail& detail) {
  switch (finish) {
    case Finish::Textured: {
      const double own = std::min(detail.contrast * draw.between(0.35, 0.8), 0.9);
      Texture texture = draw_noise(draw, pixel_units, own, detail.size);
      if (draw.chance(0.3)) add_random_pattern(texture, draw, pixel_units, detail);
      return texture;
    }
    case Finish::Plain: {
      const double own = detail.contrast * draw.between(0.03, 0.12);
      return draw_noise(draw, pixel_units, own, detail.size);
    }
    case Finish::Periodic: {
      const double own = detail.contrast * draw.between(0, 0.12);
      Texture texture = draw_noise(draw, pixel_units, own, detail.size);
      add_random_pattern(texture, draw, pixel_units, detail);
      return texture;
    }
    case Finish::Shiny:
      break;
  }
  const double own = detail.contrast * draw.between(0.1, 0.45);
  Texture texture = draw_noise(draw, pixel_units, own, detail.size);
  texture.gloss = static_cast<float>(draw.between(0.25, 0.7));
  return texture;
}

Texture draw_defocused_texture(Draw draw, double pixel_units, const Detail& detail) {
  const double blur = draw.between(3, 8);
  const unsigned seed = draw.bits();
  const std::array<float, 3> color = draw_color(draw);
  return noise_texture(blur * pixel_units, seed, color, static_cast<float>(0.6 * detail.contrast));
}

Texture draw_chequered_texture(Draw draw, double pixel_units, const Detail& detail) {
  const double own = detail.contrast * draw.between(0.1, 0.3);
  Texture texture = draw_noise(draw, pixel_units, own, detail.size);
  const double period_px = draw.between(45, 75);
  set_pattern(texture, Pattern::Checker, detail.size * pixel_units, period_px * pixel_units,
              {Vector3{1, 0, 0}, Vector3{0, 1, 0}});
  set_second_color(texture, draw, detail.contrast);
  return texture;
}

}  // namespace episcope::scenes
