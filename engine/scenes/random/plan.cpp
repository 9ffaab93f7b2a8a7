// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/random/plan.h"

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

}  // namespace episcope::scenes
