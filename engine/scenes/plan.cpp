// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/plan.h"

#include <algorithm>
#include <utility>

namespace episcope::scenes {
namespace {

// Narrow, middling and wide ones, symmetrical or not.
Interval draw_range(Draw& draw) {
  constexpr double limits[4] = {0.4, 1.2, 3.2, 2 * kMostDisparity};
  const int width = draw.weighted(std::array<double, 3>{0.25, 0.45, 0.3});
  const double span = draw.between(limits[width], limits[width + 1]);
  const double room = kMostDisparity - span / 2;
  const double first = draw.between(-room, room);
  const double second = draw.between(-room, room);
  const double middle = (first + second) / 2;
  return {middle - span / 2, middle + span / 2};
}

Sensor draw_sensor(Draw& draw) {
  Sensor sensor;
  const double exposure = draw.unit();
  const bool is_dark = draw.chance(0.12);
  sensor.exposure = static_cast<float>(is_dark ? 0.2 + 0.25 * exposure : 0.75 + 0.3 * exposure);
  const bool is_clean = draw.chance(0.3);
  const double noise = 10 * draw.small();
  if (!is_clean) sensor.noise_top = static_cast<float>(noise);
  sensor.noise_bottom = sensor.noise_top;
  const double fall_off = draw.between(0.1, 0.5);
  if (draw.chance(0.3)) sensor.vignetting = static_cast<float>(fall_off);
  const double gain = draw.between(0.01, 0.06);
  if (draw.chance(0.25)) sensor.gain_spread = static_cast<float>(gain);
  return sensor;
}

Plan draw_any(Draw& draw) {
  Plan plan;
  plan.range = draw_range(draw);
  plan.objects = 3 + static_cast<int>(38 * draw.small());
  plan.finishes = {0.55, 0.12, 0.18, 0.15};
  plan.forms = {1, 1, 1, 0.6, 0.8, 0.7, 1, 0.9, 0.5, 0.6, 0.5};
  plan.has_ground = draw.chance(0.65);
  plan.is_defocused = draw.chance(0.2);
  plan.detail.contrast = draw.between(0.6, 1.2);
  plan.is_lit = draw.chance(0.85);
  plan.has_moving_highlights = draw.chance(0.3);
  plan.sensor = draw_sensor(draw);
  return plan;
}

void make_occlusion(Plan& plan, Draw& draw) {
  plan.has_layers = true;
  plan.has_ground = false;
  plan.is_defocused = false;
  const double span = draw.between(0.8, 3);
  const double room = 2 - span / 2;
  const double middle = draw.between(-room, room);
  plan.range = {middle - span / 2, middle + span / 2};
  plan.objects = draw.integer(3, 24);
  plan.finishes = {0.9, 0.05, 0.05, 0};
  plan.forms = {0, 0, 0, 0, 0, 1, 1, 2, 1, 0.7, 0};
  plan.sensor.noise_top = 0;
  plan.sensor.noise_bottom = static_cast<float>(draw.between(2, 10));
}

void make_dark(Plan& plan, Draw& draw) {
  plan.range = {draw.between(-3.1, -2.9), draw.between(2.9, 3.1)};
  plan.sensor.exposure = static_cast<float>(draw.between(0.15, 0.35));
  plan.sensor.noise_top = plan.sensor.noise_bottom = static_cast<float>(draw.between(0, 2));
}

void make_uneven(Plan& plan, Draw& draw) {
  plan.sensor.gain_spread = static_cast<float>(draw.between(0.03, 0.15));
  plan.sensor.vignetting = static_cast<float>(draw.between(0.2, 0.6));
  plan.is_defocused = true;
}

void make_shiny(Plan& plan) {
  plan.finishes = {0.2, 0, 0, 0.8};
  plan.forms = {2, 1, 2, 1, 2, 0.5, 0.5, 0.2, 0.1, 0.1, 0.1};
  plan.is_lit = plan.has_moving_highlights = true;
}

void make_noisy(Plan& plan, Draw& draw) {
  plan.sensor.noise_top = plan.sensor.noise_bottom = static_cast<float>(draw.between(5, 10));
  plan.sensor.exposure = 1;
}

void make_room(Plan& plan, Draw& draw) {
  const double span = draw.between(1.6, 3.2);
  const double middle = draw.between(-0.6, 0.6);
  plan.range = {middle - span / 2, middle + span / 2};
  plan.is_furnished = plan.has_ground = plan.is_lit = true;
  plan.is_defocused = plan.has_moving_highlights = false;
  plan.sensor.exposure = 1;
  plan.sensor.gain_spread = 0;
  plan.sensor.noise_top = plan.sensor.noise_bottom = static_cast<float>(draw.between(0, 3));
}

void make_smooth(Plan& plan, Draw& draw) {
  const double span = draw.between(1, 3.2);
  const double middle = draw.between(-0.8, 0.8);
  plan.range = {middle - span / 2, middle + span / 2};
  plan.objects = draw.integer(3, 7);
  plan.finishes = {0.1, 0.9, 0, 0};
  plan.forms = {};
  const std::pair<Form, double> weights[] = {{Form::Drape, 3},      {Form::Vase, 1},
                                             {Form::Ball, 0.7},     {Form::Panel, 1},
                                             {Form::Cylinder, 0.5}, {Form::Leaf, 0.4}};
  for (const auto& [form, weight] : weights) plan.forms[static_cast<std::size_t>(form)] = weight;
  plan.is_defocused = plan.has_moving_highlights = false;
  plan.is_lit = true;
  plan.sensor = {};
  plan.sensor.noise_top = plan.sensor.noise_bottom = static_cast<float>(draw.between(0, 2));
}

void make_aliased(Plan& plan, Draw& draw) {
  plan.finishes = {0.75, 0.1, 0.1, 0.05};
  plan.is_defocused = false;
  plan.detail.size = draw.between(0.12, 0.5);
  const bool is_sampled = draw.chance(0.5);
  const double fill = draw.between(0.2, 1);
  plan.sensor = {};
  plan.sensor.fill = is_sampled ? 0 : static_cast<float>(fill);
  plan.sensor.noise_top = plan.sensor.noise_bottom = static_cast<float>(draw.between(0, 2));
}

void make_faint(Plan& plan, Draw& draw) {
  plan.range.min = draw.between(-3.2, -1.2);
  plan.range.max = draw.between(1.2, 2.8);
  plan.objects = draw.integer(3, 6);
  plan.finishes = {0.7, 0.15, 0.1, 0.05};
  plan.has_ground = plan.is_defocused = plan.has_moving_highlights = false;
  plan.is_faint = plan.is_lit = true;
  plan.sensor = {};
  plan.sensor.noise_top = plan.sensor.noise_bottom = static_cast<float>(draw.between(1, 2));
}

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

Plan draw_plan(Draw draw, RandomKind kind) {
  Plan plan = draw_any(draw);
  switch (kind) {
    case RandomKind::Any:
      plan.has_layers = draw.chance(0.1);
      break;
    case RandomKind::Occlusion:
      make_occlusion(plan, draw);
      break;
    case RandomKind::Dark:
      make_dark(plan, draw);
      break;
    case RandomKind::Thin:
      plan.forms = {0.2, 0.2, 0.2, 0, 0, 0.1, 0.1, 3, 2, 1.5, 2};
      plan.objects = draw.integer(8, 40);
      break;
    case RandomKind::Plain:
      plan.finishes = {0.3, 0.7, 0, 0};
      plan.sensor.noise_top = plan.sensor.noise_bottom = static_cast<float>(draw.between(0, 2));
      break;
    case RandomKind::Periodic:
      plan.finishes = {0.15, 0, 0.85, 0};
      break;
    case RandomKind::Shiny:
      make_shiny(plan);
      break;
    case RandomKind::Uneven:
      make_uneven(plan, draw);
      break;
    case RandomKind::Noisy:
      make_noisy(plan, draw);
      break;
    case RandomKind::Room:
      make_room(plan, draw);
      break;
    case RandomKind::Smooth:
      make_smooth(plan, draw);
      break;
    case RandomKind::Aliased:
      make_aliased(plan, draw);
      break;
    case RandomKind::Faint:
      make_faint(plan, draw);
      break;
  }
  return plan;
}

Stage draw_stage(int width, int height, const Interval& range, Draw draw) {
  Stage stage = make_stage(width, height);
  const double ratio = draw.between(0.33, 0.77);  // (far + shift) / (near + shift)
  constexpr double least_shift = 0.5;
  const double shift = (ratio * range.max - range.min) / (1 - ratio);
  stage.parallax = stage.zero_depth * std::max({shift, least_shift, 0.25 - range.min});
  return stage;
}

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

Texture draw_faint_texture(Draw draw, double pixel_units) {
  const double coarseness = draw.between(1, 2.5);
  const double brightness = draw.between(0.04, 0.12);
  const double contrast = draw.between(0.02, 0.06);
  const unsigned seed = draw.bits();
  std::array<float, 3> color{};
  for (float& channel : color) channel = static_cast<float>(brightness * draw.between(0.8, 1.2));
  return noise_texture(coarseness * pixel_units, seed, color, static_cast<float>(contrast));
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

Names<RandomKind> names_of(RandomKind) {
  using enum RandomKind;
  return {{Any, "any"},     {Occlusion, "occlusion"}, {Dark, "dark"},     {Thin, "thin"},
          {Plain, "plain"}, {Periodic, "periodic"},   {Shiny, "shiny"},   {Uneven, "uneven"},
          {Noisy, "noisy"}, {Room, "room"},           {Smooth, "smooth"}, {Aliased, "aliased"},
          {Faint, "faint"}};
}

}  // namespace episcope::scenes
