// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/random/backdrop.h"

#include "engine/scenes/random/materials.h"

#include <algorithm>
#include <cmath>

namespace episcope::scenes {
namespace {

// Pixels beyond the centre view that other views see, four steps away.
double margin_px(const Interval& range) {
  return 4 * std::max(std::abs(range.min), std::abs(range.max)) + 1;
}

// The wall has the least disparity of the range in one corner.
DisparityPlane draw_wall(const Stage& stage, const Plan& plan, Draw& draw) {
  const double margin = 2 * margin_px(plan.range);
  const double most = (plan.has_ground ? 0.25 : 0.45) * plan.range.length();
  const double across = most * draw.between(-1, 1);
  const double down = plan.has_ground ? 0 : most * draw.between(-1, 1);
  DisparityPlane wall;
  wall.per_x = across / (stage.width + margin);
  wall.per_y = down / (stage.height + margin);
  wall.center = plan.range.min + (std::abs(across) + std::abs(down)) / 2;
  return wall;
}

Primitive surface(const Stage& stage, const DisparityPlane& plane, int label) {
  Primitive primitive = make_plane(stage, plane);
  primitive.label = label;
  return primitive;
}

// Surfaces without end are textured as their middle is seen.
double pixel_units(const Stage& stage, double disparity_px) {
  return stage.pixel(stage.depth(disparity_px));
}

Finish draw_finish(const Plan& plan, Draw& draw) {
  return static_cast<Finish>(draw.weighted(plan.finishes));
}

}  // namespace

Backdrop::Backdrop(const Stage& stage, const Plan& plan, Draw draw)
    : stage_(stage), wall_(draw_wall(stage, plan, draw)), horizon_(stage.height) {
  const double rise = draw.between(0.45, 0.95) * plan.range.length();
  const double horizon = draw.between(0.05, 0.6) * stage.height;
  const double tilt = draw.between(-0.15, 0.15) * plan.range.length();
  if (!plan.has_ground) return;
  const double margin = margin_px(plan.range);
  DisparityPlane ground;
  // At the horizon as far away as the wall, at the lower edge, where the lowest view looks,
  // nearest.
  ground.per_y = rise / (stage.height + margin - horizon);
  ground.per_x = std::min(0.05 * plan.range.length(), plan.range.length() - rise) /
                 (stage.width + 2 * margin) * (tilt < 0 ? -1 : 1);
  const double across = std::abs(ground.per_x) * (stage.width + 2 * margin) / 2;
  ground.center = plan.range.min + rise - across - ground.per_y * (stage.height / 2.0 + margin);
  ground_ = ground;
  horizon_ = horizon;
}

double Backdrop::on(const DisparityPlane& plane, double x, double y) const {
  return plane.center + plane.per_x * (x - (stage_.width - 1) / 2.0) +
         plane.per_y * (y - (stage_.height - 1) / 2.0);
}

double Backdrop::disparity_at(double x, double y) const {
  const double wall = on(wall_, x, y);
  return ground_ ? std::max(wall, on(*ground_, x, y)) : wall;
}

int Backdrop::build(Model& model, const Plan& plan, Draw draw) const {
  Primitive wall = surface(stage_, wall_, 1);
  const double far_pixel = pixel_units(stage_, wall_.center);
  Texture texture = plan.is_defocused ? draw_defocused_texture(draw.part(0), far_pixel, plan.detail)
                                      : draw_texture(draw.part(0),
                                                     plan.is_furnished ? Finish::Periodic
                                                                       : draw_finish(plan, draw),
                                                     far_pixel, plan.detail);
  texture.is_solid = false;
  wall.texture = model.add(texture);
  model.primitives.push_back(wall);
  if (!ground_) return 2;
  Primitive ground = surface(stage_, *ground_, 2);
  const double middle = on(*ground_, stage_.width / 2.0, (horizon_ + stage_.height) / 2);
  const double near_pixel = pixel_units(stage_, middle);
  texture = plan.is_furnished
                ? draw_chequered_texture(draw.part(1), near_pixel, plan.detail)
                : draw_texture(draw.part(1), draw_finish(plan, draw), near_pixel, plan.detail);
  texture.is_solid = false;
  // It is seen at a slant.
  const double slant = std::max(1.0, std::abs(ground.axes[2][1] / ground.axes[2][2]));
  texture.stretch[1] *= std::min(slant, 8.0);
  ground.texture = model.add(texture);
  model.primitives.push_back(ground);
  return 3;
}

}  // namespace episcope::scenes
