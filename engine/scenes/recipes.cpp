// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/recipes.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <vector>

namespace episcope::scenes {
namespace {

constexpr double kEndless = 1e3;

/// Where something stands on the table: `x` to the right, `y` above the table, `z` away from the
/// cameras, in scene units; turned by `turn` (cosine and sine) about the upright axis.
struct Place {
  double x = 0;
  double y = 0;
  double z = 0;
  std::array<double, 2> turn{1, 0};
};

/// Builds scenes of objects on a table, which the cameras look down on.
class StillLife {
 public:
  /// The lower edge of the image shows the table at `front_disparity`. `pitch` is cosine and sine
  /// of the angle by which the cameras look down.
  StillLife(const Stage& stage, std::array<double, 2> pitch, double front_disparity)
      : stage_(stage), pitch_(pitch) {
    const double depth = stage.depth(front_disparity);
    const double y = stage.point(0, stage.height - 1, depth)[1];
    // Back from the camera frame into the level frame of the room.
    table_y_ = -(pitch[0] * y + pitch[1] * depth);
    front_z_ = pitch[0] * depth - pitch[1] * y;
  }

  void table(const Texture& texture, int label) {
    Primitive& table = add(Shape::Rectangle, {0, 0, 2}, model_.add(texture), label);
    set_axes(table, direction({1, 0, 0}), direction({0, 0, 1}), direction({0, 1, 0}));
    table.extent[0] = table.extent[1] = kEndless;
  }

  void wall(double z, const Texture& texture, int label) {
    Primitive& wall = add(Shape::Rectangle, {0, 2, z}, model_.add(texture), label);
    wall.extent[0] = wall.extent[1] = kEndless;
  }

  /// `place` is the middle of the bottom.
  void box(const Place& place, const Vector3& half, const Texture& texture, int label) {
    Place middle = place;
    middle.y += half[1];
    Primitive& box = add(Shape::Box, middle, model_.add(texture), label);
    std::copy(half.begin(), half.end(), box.extent);
  }

  void sphere(const Place& center, double radius, const Texture& texture, int label) {
    Primitive& sphere = add(Shape::Revolution, center, model_.add(texture), label);
    sphere.extent[0] = -radius;
    sphere.extent[1] = radius;
    sphere.profile[0] = radius * radius;
    sphere.profile[2] = -1;
    occluder(center, radius, label);
  }

  /// A piece of a surface of revolution, see `revolve`.
  void surface_of_revolution(const Place& place, double height, const Radii& radii, int texture,
                             int label) {
    revolve(add(Shape::Revolution, place, texture, label), height, radii);
  }

  void disc(const Place& center, double radius, int texture, int label) {
    Primitive& disc = add(Shape::Disc, center, texture, label);
    set_axes(disc, direction({1, 0, 0}), direction({0, 0, 1}), direction({0, 1, 0}));
    disc.extent[0] = radius;
  }

  /// A thin rod between two points.
  void rod(const Place& from, const Place& to, double radius, int texture, int label) {
    const Vector3 along{to.x - from.x, to.y - from.y, to.z - from.z};
    const double size = length(along);
    const Vector3 y = scaled(along, 1 / size);
    const Vector3 x = normalized(cross(y, {0, 0, 1}));
    Primitive& rod = add(Shape::Revolution, from, texture, label);
    set_axes(rod, direction(x), direction(y), direction(cross(x, y)));
    rod.extent[0] = 0;
    rod.extent[1] = size;
    rod.profile[0] = radius * radius;
  }

  void occluder(const Place& center, double radius, int label) {
    const Vector3 at = position(center);
    Occluder occluder;
    for (int k = 0; k < 3; ++k) occluder.center[k] = static_cast<float>(at[k]);
    occluder.radius = static_cast<float>(radius);
    occluder.label = label;
    model_.occluders.push_back(occluder);
  }

  /// Size of a pixel of the center view at a place.
  [[nodiscard]] double pixel_at(const Place& place) const {
    return stage_.pixel(position(place)[2]);
  }

  /// Noise that is resolved there, and fades where it is not.
  [[nodiscard]] Texture noise_at(const Place& place, unsigned seed,
                                 const std::array<float, 3>& color, float contrast) const {
    Texture texture = noise_texture(pixel_at(place), seed, color, contrast);
    texture.fades = true;
    texture.is_solid = true;
    return texture;
  }

  /// A pattern along `axis` with the given period, with edges as hard as pixels there allow.
  void add_pattern(Texture& texture, Pattern pattern, const Place& place, double period,
                   const std::array<Vector3, 2>& axes) const {
    set_pattern(texture, pattern, pixel_at(place), period, axes);
  }

  void light(const Lighting& lighting, const Vector3& key_direction) {
    model_.lighting = lighting;
    model_.lighting.is_on = true;
    const Vector3 up = direction({0, 1, 0});
    const Vector3 key = scaled(direction(key_direction), 1 / length(key_direction));
    for (int k = 0; k < 3; ++k) {
      model_.lighting.up[k] = static_cast<float>(up[k]);
      model_.lighting.key_direction[k] = static_cast<float>(key[k]);
    }
  }

  [[nodiscard]] Model& model() { return model_; }

 private:
  [[nodiscard]] Vector3 direction(const Vector3& room) const {
    return {room[0], -pitch_[0] * room[1] - pitch_[1] * room[2],
            -pitch_[1] * room[1] + pitch_[0] * room[2]};
  }

  [[nodiscard]] Vector3 position(const Place& place) const {
    return direction({place.x, table_y_ + place.y, front_z_ + place.z});
  }

  Primitive& add(Shape shape, const Place& place, int texture, int label) {
    Primitive primitive;
    primitive.shape = shape;
    const Vector3 at = position(place);
    std::copy(at.begin(), at.end(), primitive.center);
    const auto [c, s] = place.turn;
    set_axes(primitive, direction({c, 0, s}), direction({0, 1, 0}), direction({-s, 0, c}));
    primitive.texture = texture;
    primitive.label = label;
    return model_.primitives.emplace_back(primitive);
  }

  Stage stage_;
  std::array<double, 2> pitch_;
  double table_y_ = 0;  // Of the table, from the cameras.
  double front_z_ = 0;  // Of the lower edge of the image, from the cameras.
  Model model_;
};

constexpr std::array<float, 3> kGrey{0.5F, 0.5F, 0.5F};
constexpr float kContrast = 0.5F;

// Far beyond the image in px, so that every view is filled.
constexpr double kFar = 1e6;

// Adds a surface at a disparity, with noise that is resolved there.
Primitive& add_noisy(Model& model, const Stage& stage, Primitive surface, double disparity,
                     unsigned seed, const std::array<float, 3>& color, float contrast) {
  surface.texture =
      model.add(noise_texture(stage.pixel(stage.depth(disparity)), seed, color, contrast));
  return model.primitives.emplace_back(surface);
}

Model single_plane(const Stage& stage, const DisparityPlane& plane, double nearest_disparity) {
  Model model;
  model.primitives.push_back(make_plane(stage, plane));
  const double pixel = stage.pixel(stage.depth(nearest_disparity));
  Texture texture = noise_texture(pixel * 1.15, 1, kGrey, kContrast);
  model.primitives.back().texture = model.add(texture);
  return model;
}

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

// A run of one label along a row or a column.
struct Run {
  int line = 0;
  int begin = 0;
  int length = 0;
};

using RunsByLabel = std::map<std::int32_t, std::vector<Run>>;

// The longest run of every label in each line; `at(line, i)` is the label at place `i` of a line.
template <class At>
RunsByLabel longest_runs(int lines, int length, const At& at) {
  RunsByLabel runs;
  for (int line = 0; line < lines; ++line) {
    for (int begin = 0; begin < length;) {
      int end = begin + 1;
      while (end < length && at(line, end) == at(line, begin)) ++end;
      auto& found = runs[at(line, begin)];
      if (found.empty() || found.back().line != line) found.push_back({line, begin, 0});
      if (end - begin > found.back().length) found.back() = {line, begin, end - begin};
      begin = end;
    }
  }
  return runs;
}

// The middle one of the long runs: long, and clear of the outline.
Run middle_run(const std::vector<Run>& runs) {
  const auto shorter = [](const Run& a, const Run& b) { return a.length < b.length; };
  const int longest = std::max_element(runs.begin(), runs.end(), shorter)->length;
  std::vector<Run> is_long;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(is_long),
               [longest](const Run& run) { return run.length >= longest * 3 / 4; });
  return is_long[is_long.size() / 2];
}

// Calls `paint(line, i)` for the middle half of the run, `thickness` lines wide.
template <class Paint>
void stroke(const Run& run, int thickness, const Paint& paint) {
  for (int i = run.begin + run.length / 4; i < run.begin + run.length * 3 / 4; ++i) {
    for (int offset = -thickness / 2; offset <= thickness / 2; ++offset) {
      paint(run.line + offset, i);
    }
  }
}

}  // namespace

Model fronto_scene(const Stage& stage) {
  constexpr double disparity = 0.37;
  return single_plane(stage, {disparity, 0, 0}, disparity);
}

Model slant_scene(const Stage& stage) {
  // The far side has the largest pixels: its texture must still be resolved.
  return single_plane(stage, {0, 2.0 / std::max(stage.width - 1, 1), 0}, -1);
}

Model edge_scene(const Stage& stage) {
  constexpr double far_disparity = -0.5;
  constexpr double near_disparity = 0.8;
  Model model;
  add_noisy(model, stage, make_plane(stage, {far_disparity, 0, 0}), far_disparity, 2,
            {0.42F, 0.50F, 0.58F}, kContrast);
  // Its left side lies between two pixels of the center view.
  const double left = stage.width / 2 - 0.5;
  const Primitive card = make_card(stage, {left, -kFar, left + 2 * kFar, kFar, near_disparity});
  add_noisy(model, stage, card, near_disparity, 3, {0.60F, 0.50F, 0.40F}, kContrast).label = 2;
  return model;
}

Model bars_scene(const Stage& stage) {
  constexpr double far_disparity = -0.4;
  constexpr double near_disparity = 0.7;
  constexpr int widths[] = {1, 2, 3, 5};
  Model model;
  add_noisy(model, stage, make_plane(stage, {far_disparity, 0, 0}), far_disparity, 4,
            {0.38F, 0.46F, 0.52F}, kContrast);
  const int texture = model.add(
      noise_texture(stage.pixel(stage.depth(near_disparity)), 5, {0.72F, 0.60F, 0.34F}, 0.4F));
  const auto add_bar = [&](const Card& card) {
    model.primitives.push_back(make_card(stage, card));
    model.primitives.back().label = 2;
    model.primitives.back().texture = texture;
  };
  // Upright bars in the upper half, lying ones in the lower half, each on whole pixels.
  const double upper = stage.height * 9 / 20 - 0.5;
  const double lower = stage.height * 11 / 20 - 0.5;
  for (int i = 0; i < 8; ++i) {
    const double x = stage.width * (2 * i + 1) / 16 - 0.5;
    add_bar({x, stage.height / 20 - 0.5, x + widths[i % 4], upper, near_disparity});
  }
  for (int i = 0; i < 4; ++i) {
    const double y = lower + stage.height * (2 * i + 1) / 20;
    add_bar(
        {stage.width / 20 - 0.5, y, stage.width * 19 / 20 - 0.5, y + widths[i], near_disparity});
  }
  return model;
}

Model transparent_scene(const Stage& stage) {
  constexpr double far_disparity = -0.5;
  constexpr double near_disparity = 0.5;
  Model model;
  add_noisy(model, stage, make_plane(stage, {far_disparity, 0, 0}), far_disparity, 6,
            {0.45F, 0.55F, 0.45F}, 0.7F);
  const double w = stage.width, h = stage.height;
  Primitive pane = make_card(
      stage, {w / 8 - 0.5, h / 8 - 0.5, w * 7 / 8 - 0.5, h * 7 / 8 - 0.5, near_disparity});
  pane.label = 2;
  pane.is_pane = true;
  add_noisy(model, stage, pane, near_disparity, 7, {0.60F, 0.50F, 0.45F}, 0.7F);
  return model;
}

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

Model demo_scene(const Stage& stage) {
  StillLife scene(stage, kPitch, kFrontDisparity);
  add_room(scene);
  add_vase(scene);
  add_balls(scene);
  add_solids(scene);

  Lighting lighting;
  set_color(lighting.sky, {0.60F, 0.63F, 0.68F});
  set_color(lighting.ground, {0.30F, 0.26F, 0.24F});
  set_color(lighting.key, {0.72F, 0.66F, 0.56F});
  scene.light(lighting, {-0.75, 1.1, -0.65});
  return scene.model();
}

Image<std::int32_t> scribble(ImageView<const std::int32_t> labels) {
  Image<std::int32_t> painted(labels.height, labels.width);
  const int thickness = std::max(1, std::max(labels.height, labels.width) / 128);
  const auto paint = [&](int y, int x, std::int32_t label) {
    if (y < 0 || y >= labels.height || x < 0 || x >= labels.width) return;
    if (labels.at(y, x) == label) painted.at(y, x) = label;
  };
  const auto rows =
      longest_runs(labels.height, labels.width, [&](int y, int x) { return labels.at(y, x); });
  const auto columns =
      longest_runs(labels.width, labels.height, [&](int x, int y) { return labels.at(y, x); });
  for (const auto& entry : rows) {
    const std::int32_t label = entry.first;
    stroke(middle_run(entry.second), thickness, [&](int y, int x) { paint(y, x, label); });
  }
  for (const auto& entry : columns) {
    const std::int32_t label = entry.first;
    stroke(middle_run(entry.second), thickness, [&](int x, int y) { paint(y, x, label); });
  }
  return painted;
}

}  // namespace episcope::scenes
