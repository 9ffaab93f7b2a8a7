// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/random_scene.h"

#include "engine/scenes/objects.h"
#include "engine/scenes/plan.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

namespace episcope::scenes {
namespace {

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
