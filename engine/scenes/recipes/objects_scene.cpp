// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/recipes/recipes.h"
#include "engine/scenes/recipes/still_life.h"

namespace episcope::scenes {

Model objects_scene(const Stage& stage) {
  enum Label { kGround = 1, kSphere, kBox };
  // Steep enough for the ground to fill the image.
  StillLife scene(stage, {0.6, 0.8}, 1.2);

  Texture ground = scene.noise_at({0, 0, 0}, 11, {0.56F, 0.50F, 0.42F}, 0.5F);
  ground.is_solid = false;
  ground.stretch[0] = 1.4;
  ground.stretch[1] = 1.8;  // It is seen at a slant.
  scene.table(ground, kGround);

  const Place ball{-1.1, 1.0, 2.0};
  scene.sphere(ball, 1.0, scene.noise_at(ball, 12, {0.70F, 0.38F, 0.28F}, 0.5F), kSphere);

  const Place box{1.15, 0, 3.1, {0.8, 0.6}};
  scene.box(box, {0.8, 0.75, 0.8}, scene.noise_at(box, 13, {0.36F, 0.52F, 0.68F}, 0.5F), kBox);
  scene.occluder({box.x, 0.75, box.z}, 0.95, kBox);

  Lighting lighting;
  lighting.sky[0] = lighting.sky[1] = lighting.sky[2] = 0.65F;
  lighting.ground[0] = lighting.ground[1] = lighting.ground[2] = 0.3F;
  lighting.key[0] = lighting.key[1] = lighting.key[2] = 0.6F;
  scene.light(lighting, {-0.5, 1, -0.45});
  return scene.model();
}

}  // namespace episcope::scenes
