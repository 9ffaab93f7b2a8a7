// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/recipes/recipes.h"
#include "engine/scenes/recipes/still_life.h"

#include <algorithm>

namespace episcope::scenes {
namespace {

enum Label {
  kTable = 1,
  kWall,
  kPicture,
  kVase,
  kFlowers,
  kMarble,
  kBox,
  kGreenBall,
  kCone,
  kCan,
  kYellowBall
};

constexpr std::array<double, 2> kPitch{0.84, 0.5426};
constexpr double kFrontDisparity = 1.35;
constexpr double kWallZ = 5.3;

void set_color(float (&side)[3], const std::array<float, 3>& color) {
  std::copy(color.begin(), color.end(), side);
}

void add_room(StillLife& scene) {
  const Place front{0, 0, 0.6};
  Texture wood = scene.noise_at(front, 21, {0.58F, 0.40F, 0.26F}, 0.42F);
  wood.is_solid = false;
  wood.stretch[0] = 3;  // The grain runs from left to right.
  wood.stretch[1] = 1.5;
  set_color(wood.color[1], {0.74F, 0.54F, 0.35F});
  scene.add_pattern(wood, Pattern::Stripes, front, 1.0, {Vector3{0.12, 1, 0}, Vector3{}});
  wood.pattern_warp = 0.14F;
  scene.table(wood, kTable);

  const Place back{0, 1, kWallZ};
  Texture plaster = scene.noise_at(back, 22, {0.46F, 0.55F, 0.60F}, 0.32F);
  plaster.is_solid = false;
  plaster.stretch[0] = 1.2;
  plaster.stretch[1] = 1.4;
  set_color(plaster.color[1], {0.58F, 0.66F, 0.68F});
  scene.add_pattern(plaster, Pattern::Stripes, back, 0.8, {Vector3{1, 0, 0}, Vector3{}});
  scene.wall(kWallZ, plaster, kWall);

  const Place hook{1.55, 1.75, kWallZ - 0.12};
  scene.box(hook, {1.0, 0.75, 0.12}, scene.noise_at(hook, 23, {0.30F, 0.20F, 0.14F}, 0.15F),
            kPicture);
  const Place canvas{1.55, 1.9, kWallZ - 0.26};
  Texture painting = scene.noise_at(canvas, 24, {0.90F, 0.78F, 0.50F}, 0.25F);
  set_color(painting.color[1], {0.20F, 0.38F, 0.55F});
  scene.add_pattern(painting, Pattern::Rings, canvas, 0.42, {Vector3{1, 0, 0}, Vector3{0, 1, 0}});
  painting.pattern_warp = 0.25F;
  scene.box(canvas, {0.85, 0.60, 0.03}, painting, kPicture);
}

void add_vase(StillLife& scene) {
  const Place foot{-1.75, 0, 3.6};
  Texture ceramic = scene.noise_at(foot, 31, {0.70F, 0.71F, 0.72F}, 0.22F);
  set_color(ceramic.color[1], {0.16F, 0.30F, 0.58F});
  scene.add_pattern(ceramic, Pattern::Stripes, foot, 0.42, {Vector3{0, 1, 0}, Vector3{}});
  ceramic.pattern_warp = 0.14F;
  ceramic.gloss = 0.25F;
  const int texture = scene.model().add(ceramic);
  scene.surface_of_revolution(foot, 1.5, {0.42, 0.78, 0.38}, texture, kVase);
  Place neck = foot;
  neck.y = 1.5;
  scene.surface_of_revolution(neck, 0.6, {0.38, 0.30, 0.46}, texture, kVase);
  for (const double y : {0.55, 1.1, 1.7}) scene.occluder({foot.x, y, foot.z}, 0.55, kVase);

  const int stem = scene.model().add(scene.noise_at(neck, 32, {0.22F, 0.42F, 0.20F}, 0.2F));
  struct Flower {
    double x, y, z;
    std::array<float, 3> color;
  };
  const Flower flowers[] = {{-0.75, 1.50, 0.1, {0.86F, 0.30F, 0.36F}},
                            {-0.20, 1.85, 0.3, {0.80F, 0.62F, 0.26F}},
                            {0.38, 1.62, -0.2, {0.80F, 0.36F, 0.62F}},
                            {0.85, 1.15, 0.2, {0.92F, 0.56F, 0.30F}}};
  unsigned seed = 33;
  for (const Flower& flower : flowers) {
    const Place bloom{neck.x + flower.x, neck.y + flower.y, neck.z + flower.z};
    scene.rod({neck.x, neck.y, neck.z}, bloom, 0.028, stem, kFlowers);
    scene.sphere(bloom, 0.25, scene.noise_at(bloom, seed++, flower.color, 0.45F), kFlowers);
  }
}

void add_balls(StillLife& scene) {
  const Place marble{-0.75, 0.78, 1.55};
  Texture veins = scene.noise_at(marble, 41, {0.80F, 0.34F, 0.20F}, 0.25F);
  set_color(veins.color[1], {0.80F, 0.62F, 0.38F});
  scene.add_pattern(veins, Pattern::Stripes, marble, 0.55, {Vector3{0.6, 0.8, 0.2}, Vector3{}});
  veins.pattern_warp = 0.9F;
  veins.gloss = 0.25F;
  scene.sphere(marble, 0.78, veins, kMarble);

  const Place green{1.6, 1.30 + 0.42, 3.0};
  Texture moss = scene.noise_at(green, 42, {0.34F, 0.58F, 0.30F}, 0.45F);
  moss.gloss = 0.2F;
  scene.sphere(green, 0.42, moss, kGreenBall);

  const Place yellow{-2.05, 0.36, 0.95};
  Texture lemon = scene.noise_at(yellow, 43, {0.76F, 0.64F, 0.22F}, 0.35F);
  lemon.gloss = 0.25F;
  scene.sphere(yellow, 0.36, lemon, kYellowBall);
}

void add_solids(StillLife& scene) {
  const Place box{1.6, 0, 3.0, {0.8, 0.6}};
  Texture checks = scene.noise_at(box, 51, {0.70F, 0.66F, 0.60F}, 0.25F);
  set_color(checks.color[1], {0.36F, 0.26F, 0.40F});
  scene.add_pattern(checks, Pattern::Checker, box, 0.65, {Vector3{1, 0, 1}, Vector3{0, 1, 0}});
  scene.box(box, {0.75, 0.65, 0.75}, checks, kBox);
  scene.occluder({box.x, 0.6, box.z}, 0.85, kBox);

  const Place cone{0.25, 0, 3.9};
  Texture swirl = scene.noise_at(cone, 52, {0.82F, 0.26F, 0.24F}, 0.22F);
  set_color(swirl.color[1], {0.74F, 0.71F, 0.65F});
  scene.add_pattern(swirl, Pattern::Stripes, cone, 0.55, {Vector3{0.3, 1, 0.1}, Vector3{}});
  const int texture = scene.model().add(swirl);
  // r = 0.75·(1 − y/h): the squared radius of a cone.
  scene.surface_of_revolution(cone, 2.2, {0.75, 0.375, 0}, texture, kCone);
  scene.occluder({cone.x, 0.5, cone.z}, 0.5, kCone);
  scene.occluder({cone.x, 1.2, cone.z}, 0.3, kCone);

  const Place can{1.05, 0, 0.95};
  Texture tin = scene.noise_at(can, 53, {0.26F, 0.50F, 0.56F}, 0.30F);
  set_color(tin.color[1], {0.74F, 0.70F, 0.58F});
  scene.add_pattern(tin, Pattern::Stripes, can, 0.6, {Vector3{0, 1, 0}, Vector3{}});
  tin.gloss = 0.25F;
  scene.surface_of_revolution(can, 0.95, {0.45, 0.45, 0.45}, scene.model().add(tin), kCan);
  Place lid = can;
  lid.y = 0.95;
  const Texture tin_lid = scene.noise_at(lid, 54, {0.66F, 0.66F, 0.63F}, 0.30F);
  scene.disc(lid, 0.45, scene.model().add(tin_lid), kCan);
  scene.occluder({can.x, 0.35, can.z}, 0.45, kCan);
  scene.occluder({can.x, 0.7, can.z}, 0.42, kCan);
}

}  // namespace

Model demo_scene(const Stage& stage) {
  StillLife scene(stage, kPitch, kFrontDisparity);
  add_room(scene);
  add_vase(scene);
  add_balls(scene);
  add_solids(scene);

  Lighting lighting;
  const float sky[3] = {0.60F, 0.63F, 0.68F};
  const float ground[3] = {0.30F, 0.26F, 0.24F};
  const float key[3] = {0.72F, 0.66F, 0.56F};
  for (int c = 0; c < 3; ++c) {
    lighting.sky[c] = sky[c];
    lighting.ground[c] = ground[c];
    lighting.key[c] = key[c];
  }
  scene.light(lighting, {-0.75, 1.1, -0.65});
  return scene.model();
}

}  // namespace episcope::scenes
