// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/random_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace episcope::scenes {

namespace {

/// Place of an object in the center view.
struct Spot {
  double x = 0;  ///< Its middle, px.
  double y = 0;
  double disparity_px = 0;
  double half_px = 0;  ///< About half its size.
};

// Rows are the own axes.
using Rotation = std::array<Vector3, 3>;

constexpr Rotation kUpright = {Vector3{1, 0, 0}, Vector3{0, -1, 0}, Vector3{0, 0, -1}};

// Of the quaternion (1, q), which needs no function of the maths library.
Rotation rotation(const Vector3& q) {
  const auto [x, y, z] = q;
  const double n = 1 / (1 + x * x + y * y + z * z);
  return {Vector3{1 - 2 * n * (y * y + z * z), 2 * n * (x * y - z), 2 * n * (x * z + y)},
          Vector3{2 * n * (x * y + z), 1 - 2 * n * (x * x + z * z), 2 * n * (y * z - x)},
          Vector3{2 * n * (x * z - y), 2 * n * (y * z + x), 1 - 2 * n * (x * x + y * y)}};
}

Rotation draw_rotation(Draw& draw, double tilt, double roll) {
  const double x = draw.between(-tilt, tilt);
  const double y = draw.between(-tilt, tilt);
  const double z = draw.between(-roll, roll);
  return rotation({x, y, z});
}

// `inner` in the frame of `outer`.
Rotation combined(const Rotation& inner, const Rotation& outer) {
  Rotation result{};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < 3; ++j) result[i][k] += inner[i][j] * outer[j][k];
    }
  }
  return result;
}

// Puts surfaces together in the frame of an object: y upwards, in units of half its size.
class Assembly {
 public:
  Assembly(const Vector3& center, const Rotation& axes, double unit)
      : center_(center), axes_(axes), unit_(unit) {}

  Primitive& add(Shape shape, const Vector3& at, const Rotation& turn = rotation({})) {
    Primitive primitive;
    primitive.shape = shape;
    const Rotation axes = combined(turn, axes_);
    for (int i = 0; i < 3; ++i) {
      primitive.center[i] = center_[i];
      for (int k = 0; k < 3; ++k) primitive.center[i] += unit_ * at[k] * axes_[k][i];
      std::copy(axes[i].begin(), axes[i].end(), primitive.axes[i]);
    }
    return parts_.emplace_back(primitive);
  }

  void flat(Shape shape, const Vector3& at, double x, double y,
            const Rotation& turn = rotation({})) {
    Primitive& part = add(shape, at, turn);
    part.extent[0] = x * unit_;
    part.extent[1] = y * unit_;
  }

  void revolved(double bottom_y, double height, const Radii& radii) {
    revolve(add(Shape::Revolution, {0, bottom_y, 0}), height * unit_,
            {radii.bottom * unit_, radii.middle * unit_, radii.top * unit_});
  }

  // An upright cylinder about (x, z) of `foot`.
  void pleat(const Vector3& foot, double height, double radius) {
    const double r = radius * unit_;
    revolve(add(Shape::Revolution, foot), height * unit_, {r, r, r});
  }

  // A disc that closes a surface of revolution.
  void lid(double y, double radius) {
    flat(Shape::Disc, {0, y, 0}, radius, radius, rotation({1, 0, 0}));
  }

  [[nodiscard]] double unit() const { return unit_; }
  std::vector<Primitive> take() { return std::move(parts_); }

 private:
  Vector3 center_;
  Rotation axes_;
  double unit_;
  std::vector<Primitive> parts_;
};

void add_ball(Assembly& object) {
  Primitive& ball = object.add(Shape::Revolution, {});
  const double radius = object.unit();
  ball.extent[0] = -radius;
  ball.extent[1] = radius;
  ball.profile[0] = radius * radius;
  ball.profile[2] = -1;
}

void add_box(Assembly& object, Draw& draw) {
  Primitive& box = object.add(Shape::Box, {});
  const double shares[3] = {draw.between(0.4, 1), 1, draw.between(0.3, 0.8)};
  for (int i = 0; i < 3; ++i) box.extent[i] = shares[i] * object.unit();
}

void add_cylinder(Assembly& object, Draw& draw) {
  const double radius = draw.between(0.3, 0.8);
  object.revolved(-1, 2, {radius, radius, radius});
  object.lid(1, radius);
  object.lid(-1, radius);
}

void add_cone(Assembly& object, Draw& draw) {
  const double radius = draw.between(0.4, 0.9);
  object.revolved(-1, 2, {radius, radius / 2, 0});
}

void add_vase(Assembly& object, Draw& draw) {
  const double foot = draw.between(0.2, 0.5);
  const double belly = draw.between(0.5, 0.8);
  const double neck = draw.between(0.15, 0.4);
  const double mouth = draw.between(0.2, 0.55);
  object.revolved(-1, 1.4, {foot, belly, neck});
  object.revolved(0.4, 0.6, {neck, (neck + mouth) / 2.2, mouth});
}

void add_bar(Assembly& object, Draw& draw, double half_px) {
  const double width_px = 0.5 + 3.5 * draw.small();
  const double share = width_px / half_px;
  if (draw.chance(0.5)) {
    object.flat(Shape::Rectangle, {}, share, 1.6);
  } else {
    object.revolved(-1.6, 3.2, {share, share, share});
  }
}

void add_lattice(Assembly& object, Draw& draw, double half_px) {
  Primitive& lattice = object.add(Shape::Lattice, {});
  const double width_px = 0.6 + 3 * draw.small();
  const double pitch_px = (2 * width_px) * draw.between(2, 5) + 3;
  const double unit = object.unit() / half_px;
  lattice.extent[0] = 1.2 * object.unit();
  lattice.extent[1] = draw.between(0.7, 1.2) * object.unit();
  lattice.extent[2] = draw.chance(0.6) ? width_px * unit : -1;
  lattice.profile[0] = pitch_px * unit;
  lattice.profile[1] = pitch_px * draw.between(1, 3) * unit;
  lattice.profile[2] = width_px * unit;
}

void add_plant(Assembly& object, Draw& draw) {
  const double stem = draw.between(0.015, 0.04);
  object.revolved(-1, 1.8, {stem * 1.5, stem, stem / 2});
  const int leaves = draw.integer(4, 9);
  for (int i = 0; i < leaves; ++i) {
    const double side = i % 2 == 0 ? 1 : -1;
    const double y = -0.5 + 1.3 * (i + 0.5) / leaves;
    const double length = draw.between(0.25, 0.5);
    const double breadth = length * draw.between(0.25, 0.5);
    const double out = draw.between(-0.25, 0.25);
    const Rotation turn = draw_rotation(draw, 0.35, 0.5);
    object.flat(Shape::Leaf, {side * (length + stem), y, out}, length, breadth, turn);
  }
}

// Cloth in folds: upright cylinders that run into each other, of one width and not of one depth.
void add_drape(Assembly& object, Draw& draw) {
  const int folds = draw.integer(3, 8);
  const double half_width = 1.1 / folds;
  const double height = draw.between(1.6, 2.6);
  for (int i = 0; i < folds; ++i) {
    const double radius = half_width * draw.between(1.15, 2);
    const double out = half_width * draw.between(-0.3, 0.3) - radius;
    object.pleat({(2 * i + 1) * half_width - 1.1, -height / 2, out}, height, radius);
  }
}

void add_parts(Assembly& object, Form form, Draw& draw, double half_px) {
  switch (form) {
    case Form::Ball:
      return add_ball(object);
    case Form::Box:
      return add_box(object, draw);
    case Form::Cylinder:
      return add_cylinder(object, draw);
    case Form::Cone:
      return add_cone(object, draw);
    case Form::Vase:
      return add_vase(object, draw);
    case Form::Disc:
      return object.flat(Shape::Disc, {}, 0.9, 0.9);
    case Form::Panel: {
      const double breadth = draw.between(0.5, 1);
      return object.flat(Shape::Rectangle, {}, 1, breadth);
    }
    case Form::Bar:
      return add_bar(object, draw, half_px);
    case Form::Lattice:
      return add_lattice(object, draw, half_px);
    case Form::Leaf: {
      const double breadth = draw.between(0.25, 0.6);
      return object.flat(Shape::Leaf, {}, 1, breadth);
    }
    case Form::Plant:
      return add_plant(object, draw);
    case Form::Drape:
      return add_drape(object, draw);
  }
}

// Standing objects turn about the upright axis; flat ones face the cameras more or less.
Rotation draw_axes(Form form, bool stands, Draw& draw) {
  if (stands) {
    const double tilt = draw.between(-0.15, 0.05);
    const double turn = form == Form::Plant ? draw.between(-0.3, 0.3) : draw.between(-1, 1);
    return combined(rotation({0, turn, 0}), combined(rotation({tilt, 0, 0}), kUpright));
  }
  switch (form) {
    case Form::Disc:
    case Form::Panel:
      return combined(draw_rotation(draw, 0.35, 1), kUpright);
    case Form::Bar:
      return combined(draw_rotation(draw, 0.15, 1), kUpright);
    case Form::Lattice:
      return combined(draw_rotation(draw, 0.2, 0.4), kUpright);
    case Form::Plant:
      return combined(draw_rotation(draw, 0.15, 0.3), kUpright);
    default:
      return combined(draw_rotation(draw, 0.6, 0.8), kUpright);
  }
}

/// Whether an object of this form can stand on the ground.
bool can_stand(Form form) {
  return form != Form::Disc && form != Form::Panel && form != Form::Bar && form != Form::Lattice &&
         form != Form::Leaf;
}

/// Moves a primitive away by `factor` and enlarges it as much: the same picture from the center
/// view.
void move_away(Primitive& primitive, double factor) {
  for (double& c : primitive.center) c *= factor;
  for (double& e : primitive.extent) e *= factor;
  if (primitive.shape == Shape::Revolution) {
    primitive.profile[0] *= factor * factor;
    primitive.profile[1] *= factor;
  } else {
    for (double& p : primitive.profile) p *= factor;
  }
}

/// The surfaces of a random object, without label and texture. Objects that reach nearer than
/// disparity `nearest_px` are moved away and enlarged, so that they look the same from the center
/// view. `stands`: its lower end points down.
std::vector<Primitive> make_object(const Stage& stage, Form form, const Spot& spot,
                                   double nearest_px, bool stands, Draw draw) {
  const double depth = stage.depth(spot.disparity_px);
  const Vector3 center = stage.point(spot.x, spot.y, depth);
  const Rotation axes = draw_axes(form, stands, draw);
  Assembly object(center, axes, spot.half_px * stage.pixel(depth));
  add_parts(object, form, draw, spot.half_px);
  std::vector<Primitive> parts = object.take();
  double near_depth = depth;
  for (const Primitive& part : parts) near_depth = std::min(near_depth, depths_of(part).min);
  const double nearest = stage.depth(nearest_px);
  if (near_depth <= 0.2 * nearest) return {};
  if (near_depth < nearest) {
    for (Primitive& part : parts) move_away(part, nearest / near_depth);
  }
  return parts;
}

/// An object that stands in every furnished room.
struct IndoorObject {
  Form form = Form::Box;
  Finish finish = Finish::Textured;
  bool stands = true;
  double half_share = 0.1;  ///< About half its size, as a share of the smaller side of a view.
};

// What a furnished room holds: two boxes, a tilted panel, two cylinders, three balls and a
// lattice, some of them of one color.
std::span<const IndoorObject> indoor_objects() {
  static constexpr IndoorObject all[] = {
      {Form::Box, Finish::Textured, true, 0.17},     {Form::Box, Finish::Plain, true, 0.14},
      {Form::Panel, Finish::Textured, false, 0.15},  {Form::Cylinder, Finish::Plain, true, 0.12},
      {Form::Cylinder, Finish::Periodic, true, 0.1}, {Form::Ball, Finish::Textured, true, 0.09},
      {Form::Ball, Finish::Plain, true, 0.08},       {Form::Ball, Finish::Shiny, true, 0.07},
      {Form::Lattice, Finish::Plain, false, 0.16},
  };
  return all;
}

// Half the width of the bars of the lattice, px of the center view.
double draw_bar_px(Draw draw) {
  return draw.between(0.8, 2);
}

/// What lies behind all objects: a wall, and maybe ground that rises towards it.
class Backdrop {
 public:
  /// Disparities stay in the range of the plan as far as views of a 9×9 grid see.
  Backdrop(const Stage& stage, const Plan& plan, Draw draw);

  /// Disparity at a pixel of the center view.
  [[nodiscard]] double disparity_at(double x, double y) const;
  /// Row above which no ground is seen; the height of the image if there is none.
  [[nodiscard]] double horizon() const { return horizon_; }

  /// Adds the surfaces with labels from 1 on; returns the next label.
  int build(Model& model, const Plan& plan, Draw draw) const;

 private:
  [[nodiscard]] double on(const DisparityPlane& plane, double x, double y) const;

  const Stage& stage_;
  DisparityPlane wall_;
  std::optional<DisparityPlane> ground_;
  double horizon_ = 0;
};

// Pixels beyond the center view that other views see, four steps away.
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

Texture wall_texture(const Plan& plan, double pixel_units, Draw& draw) {
  if (plan.is_faint) return draw_faint_texture(draw.part(0), pixel_units);
  if (plan.is_defocused) return draw_defocused_texture(draw.part(0), pixel_units, plan.detail);
  const Finish finish = plan.is_furnished ? Finish::Periodic : draw_finish(plan, draw);
  return draw_texture(draw.part(0), finish, pixel_units, plan.detail);
}

int Backdrop::build(Model& model, const Plan& plan, Draw draw) const {
  Primitive wall = surface(stage_, wall_, 1);
  const double far_pixel = pixel_units(stage_, wall_.center);
  Texture texture = wall_texture(plan, far_pixel, draw);
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

constexpr std::size_t kMostOccluders = 24;
constexpr double kLeastGap = 0.15;  // Share of the range between an object and what is behind.
constexpr double kMostStep = 1.5;   // Of disparity, px, where layers occlude each other.

class Composer {
 public:
  Composer(const Stage& stage, const Plan& plan, Draw draw)
      : stage_(stage), plan_(plan), draw_(draw), backdrop_(stage, plan, draw.part(1)) {
    next_label_ = backdrop_.build(model_, plan, draw.part(2));
  }

  Model compose() {
    if (plan_.has_layers) add_fences(draw_.part(3));
    if (plan_.is_furnished) {
      furnish();
    } else {
      for (int i = 0; i < plan_.objects; ++i) add_object(draw_.part(100 + i));
    }
    set_light(draw_.part(4));
    model_.sensor = plan_.sensor;
    return std::move(model_);
  }

 private:
  void furnish() {
    const double side = std::min(stage_.width, stage_.height);
    int number = 100;
    for (const IndoorObject& piece : indoor_objects()) {
      Draw draw = draw_.part(number++);
      const double half_px = side * piece.half_share * draw.between(0.85, 1.15);
      const Spot spot = piece.stands ? draw_standing(draw, half_px) : draw_floating(draw, half_px);
      put({piece.form, piece.finish, piece.stands}, spot, draw);
    }
  }

  void add_object(Draw draw) {
    const auto form = static_cast<Form>(draw.weighted(plan_.forms));
    const auto finish = static_cast<Finish>(draw.weighted(plan_.finishes));
    const bool stands = plan_.has_ground && can_stand(form) && draw.chance(0.75);
    const double half_px = draw_half_px(draw);
    const Spot spot = stands ? draw_standing(draw, half_px) : draw_floating(draw, half_px);
    put({form, finish, stands}, spot, draw);
  }

  struct Object {
    Form form;
    Finish finish;
    bool stands;
  };
  void put(const Object& object, const Spot& spot, const Draw& draw) {
    std::vector<Primitive> parts =
        make_object(stage_, object.form, spot, plan_.range.max, object.stands, draw.part(1));
    if (model_.primitives.size() + parts.size() > kMaxCandidates) return;
    if (plan_.is_furnished && object.form == Form::Lattice) make_thin(parts.front(), draw.part(3));
    taken_.push_back({spot.x, spot.y});
    dress(parts, object.finish, draw.part(2));
    if (can_stand(object.form)) add_occluder(parts.front(), spot);
    ++next_label_;
  }

  // Bars both ways, of the width of a room's lattice.
  void make_thin(Primitive& lattice, const Draw& draw) const {
    const double half_width = draw_bar_px(draw) * stage_.pixel(lattice.center[2]);
    lattice.profile[0] = lattice.profile[1] = 12 * half_width;
    lattice.profile[2] = lattice.extent[2] = half_width;
  }

  // Gives an object its textures and its label.
  void dress(const std::vector<Primitive>& parts, Finish finish, const Draw& draw) {
    for (Primitive part : parts) {
      const double pixel = stage_.pixel(part.center[2]);
      Texture texture = draw_texture(draw, finish, pixel, plan_.detail);
      texture.seed += static_cast<unsigned>(model_.primitives.size());  // No two leaves are alike.
      part.texture = model_.add(texture);
      part.label = next_label_;
      model_.primitives.push_back(part);
    }
  }

  void add_occluder(const Primitive& part, const Spot& spot) {
    if (model_.occluders.size() >= kMostOccluders) return;
    const Interval depths = depths_of(part);
    const double depth = (depths.min + depths.max) / 2;
    const Vector3 at = stage_.point(spot.x, spot.y, depth);
    Occluder occluder;
    for (int k = 0; k < 3; ++k) occluder.center[k] = static_cast<float>(at[k]);
    occluder.radius = static_cast<float>(0.7 * spot.half_px * stage_.pixel(depth));
    occluder.label = next_label_;
    model_.occluders.push_back(occluder);
  }

  // Few objects are large, many are small; some of each are neither.
  double draw_half_px(Draw& draw) const {
    const double side = std::min(stage_.width, stage_.height);
    const double usual = 0.42 / std::sqrt(static_cast<double>(plan_.objects));
    const double share = std::max(usual, 0.06) * draw.between(0.55, 1.5);
    return std::max(side * share, 4.0);
  }

  // Of several places the one farthest from other objects.
  std::pair<double, double> draw_place(Draw& draw, double top, double bottom) const {
    std::pair<double, double> best{};
    double farthest = -1;
    for (int i = 0; i < 6; ++i) {
      const double x = draw.between(0.04, 0.96) * stage_.width;
      const double y = draw.between(top, bottom);
      double nearest = 1e18;
      for (const auto& [other_x, other_y] : taken_) {
        const double squared = (x - other_x) * (x - other_x) + (y - other_y) * (y - other_y);
        nearest = std::min(nearest, squared);
      }
      if (nearest <= farthest) continue;
      farthest = nearest;
      best = {x, y};
    }
    return best;
  }

  Spot draw_standing(Draw& draw, double half_px) const {
    Spot spot;
    spot.half_px = half_px;
    const double top = backdrop_.horizon() + 0.05 * stage_.height;
    const auto [x, foot] = draw_place(draw, top, 1.02 * stage_.height);
    spot.x = x;
    spot.y = foot - 0.95 * spot.half_px;
    spot.disparity_px = backdrop_.disparity_at(x, foot);
    return spot;
  }

  Spot draw_floating(Draw& draw, double half_px) const {
    Spot spot;
    spot.half_px = half_px;
    const auto [x, y] = draw_place(draw, 0.04 * stage_.height, 0.96 * stage_.height);
    spot.x = x;
    spot.y = y;
    const double behind = backdrop_.disparity_at(x, y);
    double room = plan_.range.max - behind;
    if (plan_.has_layers) room = std::min(room, kMostStep);
    const double least = std::min(kLeastGap * plan_.range.length(), room);
    spot.disparity_px = behind + draw.between(least, room);
    return spot;
  }

  // Lattices across the image, one before the other, each slanted so that the step of disparity
  // grows along its bars.
  void add_fences(Draw draw) {
    const int count = draw.integer(1, 3);
    double behind = plan_.range.min + 0.45 * plan_.range.length();
    for (int i = 0; i < count; ++i) {
      const double room = std::min(plan_.range.max - behind, kMostStep);
      DisparityPlane plane;
      plane.center = behind + room * draw.between(0.4, 0.7);
      const double steepness =
          0.8 * std::min(plan_.range.max - plane.center, plane.center - behind);
      const double along = draw.sign() * draw.between(0, steepness);
      plane.per_y = along / stage_.height;
      add_fence(plane, draw.part(i));
      behind = plane.center + std::abs(along) / 2;
    }
  }

  void add_fence(const DisparityPlane& plane, Draw draw) {
    Primitive fence = make_plane(stage_, plane);
    const double pixel = stage_.pixel(fence.center[2]);
    const double half_width = (0.5 + 6 * draw.small()) * pixel;
    fence.shape = Shape::Lattice;
    fence.extent[0] = draw.between(0.2, 0.6) * stage_.width * pixel;
    fence.extent[1] = draw.between(0.25, 0.6) * stage_.height * pixel;
    fence.extent[2] = draw.chance(0.3) ? half_width : -1;
    fence.profile[0] = half_width * draw.between(4, 9) + 4 * pixel;
    fence.profile[1] = half_width * draw.between(8, 20) + 8 * pixel;
    fence.profile[2] = half_width;
    const double aside = draw.between(-0.3, 0.3) * stage_.width * pixel;
    for (int k = 0; k < 3; ++k) fence.center[k] += aside * fence.axes[0][k];
    const auto finish = static_cast<Finish>(draw.weighted(plan_.finishes));
    dress({fence}, finish, draw.part(0));
    ++next_label_;
  }

  void set_light(Draw draw) {
    Lighting& light = model_.lighting;
    light.is_on = plan_.is_lit;
    light.has_moving_highlights = plan_.has_moving_highlights;
    for (int c = 0; c < 3; ++c) {
      light.sky[c] = static_cast<float>(draw.between(0.5, 0.65));
      light.ground[c] = static_cast<float>(draw.between(0.25, 0.4));
      light.key[c] = static_cast<float>(draw.between(0.45, 0.7));
    }
    const double x = draw.between(-1, 1);
    const double y = draw.between(-1.3, -0.5);
    const double z = draw.between(-1, -0.3);
    const Vector3 key = normalized({x, y, z});
    for (int k = 0; k < 3; ++k) light.key_direction[k] = static_cast<float>(key[k]);
  }

  const Stage& stage_;
  const Plan& plan_;
  Draw draw_;
  Backdrop backdrop_;
  Model model_;
  int next_label_ = 1;
  std::vector<std::pair<double, double>> taken_;  // Places of objects.
};

}  // namespace

RandomScene random_scene(int width, int height, unsigned seed, RandomKind kind) {
  const Draw draw(seed * std::uint64_t{64} + static_cast<std::uint64_t>(kind));
  const Plan plan = draw_plan(draw.part(1), kind);
  RandomScene scene;
  scene.stage = draw_stage(width, height, plan.range, draw.part(2));
  scene.model = Composer(scene.stage, plan, draw.part(3)).compose();
  return scene;
}

}  // namespace episcope::scenes
