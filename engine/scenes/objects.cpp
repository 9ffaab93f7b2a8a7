// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/objects.h"

#include <algorithm>

namespace episcope::scenes {
namespace {

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

}  // namespace

bool can_stand(Form form) {
  switch (form) {
    case Form::Disc:
    case Form::Panel:
    case Form::Bar:
    case Form::Lattice:
    case Form::Leaf:
      return false;
    default:
      return true;
  }
}

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

}  // namespace episcope::scenes
