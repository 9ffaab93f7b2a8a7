// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/stratified/pieces.h"

#include <algorithm>
#include <cmath>

namespace episcope::scenes {
namespace {

constexpr int kWall = 1;
constexpr int kPyramids = 2;
constexpr int kBall = 3;
constexpr int kBowl = 4;
constexpr int kCells = 3;  // Along each side of a view.

void set_axes(Primitive& primitive, const Vector3& x, const Vector3& y, const Vector3& z) {
  int row = 0;
  for (const Vector3& axis : {x, y, z}) std::copy(axis.begin(), axis.end(), primitive.axes[row++]);
}

class Builder {
 public:
  Builder(const Stage& stage, double wall, Draw draw)
      : stage_(stage), wall_depth_(stage.depth(wall)), draw_(draw) {
    Primitive plane = make_plane(stage, {wall, 0, 0});
    add(plane, kWall);
  }

  // Its base stands on the wall around a pixel, its tip before the middle of the base.
  void add_pyramid(double x, double y, double half_px, double tip) {
    const Vector3 base = stage_.point(x, y, wall_depth_);
    const double half = half_px * stage_.pixel(wall_depth_);
    const double height = wall_depth_ - stage_.depth(tip);
    const double slope = std::sqrt(half * half + height * height);
    for (const auto& [out_x, out_y] : {std::pair{1, 0}, {0, 1}, {-1, 0}, {0, -1}}) {
      // From the middle of a side of the base to the tip, and along that side.
      const Vector3 up{-out_x * half / slope, -out_y * half / slope, -height / slope};
      const Vector3 along{-1.0 * out_y, 1.0 * out_x, 0};
      Primitive face;
      face.shape = Shape::Triangle;
      set_axes(face, up, along, cross(up, along));
      face.center[0] = base[0] + out_x * half / 2;
      face.center[1] = base[1] + out_y * half / 2;
      face.center[2] = base[2] - height / 2;
      face.extent[0] = slope / 2;
      face.extent[1] = half;
      add(face, kPyramids);
    }
  }

  // Half a ball on the wall, or the other half, open to the cameras, that touches it.
  void add_half_ball(double x, double y, double radius_px, int label) {
    const double radius = radius_px * stage_.pixel(wall_depth_);
    const Vector3 base = stage_.point(x, y, wall_depth_);
    Primitive ball;
    ball.shape = Shape::Revolution;
    std::copy(base.begin(), base.end(), ball.center);
    set_axes(ball, {1, 0, 0}, {0, 0, -1}, {0, 1, 0});  // Its axis points at the cameras.
    ball.profile[0] = radius * radius;
    ball.profile[2] = -1;
    ball.extent[0] = 0;
    ball.extent[1] = radius;
    if (label == kBowl) {
      ball.center[2] -= radius;
      ball.extent[0] = -radius;
      ball.extent[1] = 0;
    }
    add(ball, label);
  }

  Model take() { return std::move(model_); }

 private:
  void add(Primitive primitive, int label) {
    Texture texture =
        strong_texture(draw_.part(model_.primitives.size()), stage_.pixel(wall_depth_));
    texture.is_solid = primitive.shape == Shape::Revolution;
    primitive.texture = model_.add(texture);
    primitive.label = label;
    model_.primitives.push_back(primitive);
  }

  const Stage& stage_;
  double wall_depth_;
  Draw draw_;
  Model model_;
};

}  // namespace

Model pyramids_model(const Stage& stage, Draw draw) {
  const double wall = draw.between(-0.8, -0.3);
  Builder builder(stage, wall, draw.part(0));
  const int ball = draw.integer(0, 3);
  const int bowl = draw.integer(5, 8);
  const double cell = static_cast<double>(std::min(stage.width, stage.height)) / kCells;
  for (int i = 0; i < kCells * kCells; ++i) {
    const double x = (i % kCells + 0.5) * stage.width / kCells - 0.5;
    const double y = (i / kCells + 0.5) * stage.height / kCells - 0.5;
    const double half = cell * draw.between(0.28, 0.36);
    const double tip = wall + draw.between(0.4, 1.4);
    if (i == ball || i == bowl) {
      // Seen from before, a deep one would hide its neighbours.
      builder.add_half_ball(x, y, 0.9 * half, i == ball ? kBall : kBowl);
    } else {
      builder.add_pyramid(x, y, half, tip);
    }
  }
  return builder.take();
}

Regions pyramids_regions(const Stage& /*stage*/, CenterLabels labels) {
  Regions regions;
  regions.emplace("plane", region_of(labels, kWall));
  regions.emplace("pyramids", region_of(labels, kPyramids));
  regions.emplace("sphere_out", region_of(labels, kBall));
  regions.emplace("sphere_in", region_of(labels, kBowl));
  return regions;
}

}  // namespace episcope::scenes
