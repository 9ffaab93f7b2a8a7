// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/stratified/pieces.h"

#include <algorithm>
#include <cmath>

namespace episcope::scenes {

Texture strong_texture(Draw draw, double pixel_units) {
  std::array<float, 3> color{};
  const double brightness = draw.between(0.35, 0.65);
  for (float& channel : color) {
    channel = static_cast<float>(brightness + draw.between(-0.12, 0.12));
  }
  const double contrast = draw.between(0.35, 0.6);
  const unsigned seed = draw.bits();
  Texture texture = noise_texture(pixel_units, seed, color, static_cast<float>(contrast));
  texture.fades = true;
  return texture;
}

double disparity_at(const Stage& stage, const DisparityPlane& plane, double x, double y) {
  return plane.center + plane.per_x * (x - (stage.width - 1) / 2.0) +
         plane.per_y * (y - (stage.height - 1) / 2.0);
}

double coarsest_pixel(const Stage& stage, const DisparityPlane& plane) {
  double coarsest = 0;
  for (const double y : {0.0, stage.height - 1.0}) {
    for (const double x : {0.0, stage.width - 1.0}) {
      const double depth = stage.depth(disparity_at(stage, plane, x, y));
      coarsest = std::max(coarsest, stage.pixel(depth));
    }
  }
  return coarsest;
}

void move_to(Primitive& primitive, const Stage& stage, const DisparityPlane& plane, double x,
             double y) {
  const Vector3 at = stage.point(x, y, stage.depth(disparity_at(stage, plane, x, y)));
  std::copy(at.begin(), at.end(), primitive.center);
}

Sensor growing_noise(Draw draw, double least, double most) {
  Sensor sensor;
  sensor.noise_bottom = static_cast<float>(draw.between(least, most));
  return sensor;
}

}  // namespace episcope::scenes
