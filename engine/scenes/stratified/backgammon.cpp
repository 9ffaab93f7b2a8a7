// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/stratified/pieces.h"

#include <algorithm>

namespace episcope::scenes {
namespace {

constexpr int kWall = 1;
constexpr int kTeeth = 2;

// Columns of the centre view where the strip ends and where the tips lie. The metrics look for the
// foreground in column 14 and for the wall in the eleventh column from the right.
int strip_end(const Stage& stage) {
  return std::max(28, stage.width / 8);
}
int tip_column(const Stage& stage) {
  return std::max(strip_end(stage) + 4, stage.width - strip_end(stage));
}

}  // namespace

Model backgammon_model(const Stage& stage, Draw draw) {
  DisparityPlane wall;
  wall.center = draw.between(-0.8, -0.2);
  wall.per_y = draw.between(-0.3, 0.3) / stage.height;
  const double least_step = draw.between(0.15, 0.4);
  const double most_step = draw.between(0.9, 1.5);
  DisparityPlane teeth = wall;
  teeth.center += (least_step + most_step) / 2;
  teeth.per_y += (most_step - least_step) / stage.height;
  const int count = draw.integer(5, 8);

  Model model;
  const auto add = [&](Primitive primitive, int label) {
    primitive.label = label;
    primitive.texture = label - 1;
    model.primitives.push_back(primitive);
  };
  model.add(strong_texture(draw.part(0), coarsest_pixel(stage, wall)));
  model.add(strong_texture(draw.part(1), coarsest_pixel(stage, teeth)));
  add(make_plane(stage, wall), kWall);

  const double base = strip_end(stage) - 0.5;
  const double half_width = (tip_column(stage) - strip_end(stage)) / 2.0;
  Primitive tooth = make_plane(stage, teeth);
  Primitive strip = tooth;
  move_to(strip, stage, teeth, base, (stage.height - 1) / 2.0);
  strip.extent[0] = 1e3 * stage.pixel(strip.center[2]);
  for (int k = 0; k < 3; ++k) strip.center[k] -= strip.extent[0] * strip.axes[0][k];
  add(strip, kTeeth);
  tooth.shape = Shape::Triangle;
  for (int i = 0; i < count; ++i) {
    move_to(tooth, stage, teeth, base + half_width, (i + 0.5) * stage.height / count - 0.5);
    tooth.extent[0] = half_width * stage.pixel(tooth.center[2]);
    tooth.extent[1] = 0.5 * stage.height / count * stage.pixel(tooth.center[2]);
    add(tooth, kTeeth);
  }
  if (draw.chance(0.5)) model.sensor = growing_noise(draw.part(2), 3, 8);
  return model;
}

Regions backgammon_regions(const Stage& stage, CenterLabels labels) {
  // The strip slants with its plane: at the top its side stands further right.
  const int begin = strip_end(stage) + stage.width / 16;
  const int end = tip_column(stage);
  const auto region = [&](int label) {
    return region_where(
        labels, [&](int y, int x) { return x >= begin && x < end && labels.at(y, x) == label; });
  };
  Regions regions;
  regions.emplace("foreground_fattening", region(kWall));
  regions.emplace("foreground_thinning", region(kTeeth));
  return regions;
}

}  // namespace episcope::scenes
