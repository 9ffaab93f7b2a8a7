// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/recipes/still_life.h"

#include <algorithm>
#include <cmath>

namespace episcope::scenes {
namespace {

constexpr double kEndless = 1e3;

void set_axes(Primitive& primitive, const Vector3& x, const Vector3& y, const Vector3& z) {
  std::copy(x.begin(), x.end(), primitive.axes[0]);
  std::copy(y.begin(), y.end(), primitive.axes[1]);
  std::copy(z.begin(), z.end(), primitive.axes[2]);
}

}  // namespace

StillLife::StillLife(const Stage& stage, std::array<double, 2> pitch, double front_disparity)
    : stage_(stage), pitch_(pitch) {
  const double depth = stage.depth(front_disparity);
  const double y = stage.point(0, stage.height - 1, depth)[1];
  // Back from the camera frame into the level frame of the room.
  table_y_ = -(pitch[0] * y + pitch[1] * depth);
  front_z_ = pitch[0] * depth - pitch[1] * y;
}

Vector3 StillLife::direction(const Vector3& room) const {
  return {room[0], -pitch_[0] * room[1] - pitch_[1] * room[2],
          -pitch_[1] * room[1] + pitch_[0] * room[2]};
}

Vector3 StillLife::position(const Place& place) const {
  return direction({place.x, table_y_ + place.y, front_z_ + place.z});
}

Primitive& StillLife::add(Shape shape, const Place& place, int texture, int label) {
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

void StillLife::table(const Texture& texture, int label) {
  Primitive& table = add(Shape::Rectangle, {0, 0, 2}, model_.add(texture), label);
  set_axes(table, direction({1, 0, 0}), direction({0, 0, 1}), direction({0, 1, 0}));
  table.extent[0] = table.extent[1] = kEndless;
}

void StillLife::wall(double z, const Texture& texture, int label) {
  Primitive& wall = add(Shape::Rectangle, {0, 2, z}, model_.add(texture), label);
  wall.extent[0] = wall.extent[1] = kEndless;
}

void StillLife::box(const Place& place, const Vector3& half, const Texture& texture, int label) {
  Place middle = place;
  middle.y += half[1];
  Primitive& box = add(Shape::Box, middle, model_.add(texture), label);
  std::copy(half.begin(), half.end(), box.extent);
}

void StillLife::sphere(const Place& center, double radius, const Texture& texture, int label) {
  Primitive& sphere = add(Shape::Revolution, center, model_.add(texture), label);
  sphere.extent[0] = -radius;
  sphere.extent[1] = radius;
  sphere.profile[0] = radius * radius;
  sphere.profile[2] = -1;
  occluder(center, radius, label);
}

void StillLife::surface_of_revolution(const Place& place, double height, const Radii& radii,
                                      int texture, int label) {
  revolve(add(Shape::Revolution, place, texture, label), height, radii);
}

void StillLife::disc(const Place& center, double radius, int texture, int label) {
  Primitive& disc = add(Shape::Disc, center, texture, label);
  set_axes(disc, direction({1, 0, 0}), direction({0, 0, 1}), direction({0, 1, 0}));
  disc.extent[0] = radius;
}

void StillLife::rod(const Place& from, const Place& to, double radius, int texture, int label) {
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

void StillLife::occluder(const Place& center, double radius, int label) {
  const Vector3 at = position(center);
  Occluder occluder;
  for (int k = 0; k < 3; ++k) occluder.center[k] = static_cast<float>(at[k]);
  occluder.radius = static_cast<float>(radius);
  occluder.label = label;
  model_.occluders.push_back(occluder);
}

double StillLife::pixel_at(const Place& place) const {
  return stage_.pixel(position(place)[2]);
}

Texture StillLife::noise_at(const Place& place, unsigned seed, const std::array<float, 3>& color,
                            float contrast) const {
  Texture texture = noise_texture(pixel_at(place), seed, color, contrast);
  texture.fades = true;
  texture.is_solid = true;
  return texture;
}

void StillLife::add_pattern(Texture& texture, Pattern pattern, const Place& place, double period,
                            const std::array<Vector3, 2>& axes) const {
  set_pattern(texture, pattern, pixel_at(place), period, axes);
}

void StillLife::light(const Lighting& lighting, const Vector3& key_direction) {
  model_.lighting = lighting;
  model_.lighting.is_on = true;
  const Vector3 up = direction({0, 1, 0});
  const Vector3 key = scaled(direction(key_direction), 1 / length(key_direction));
  for (int k = 0; k < 3; ++k) {
    model_.lighting.up[k] = static_cast<float>(up[k]);
    model_.lighting.key_direction[k] = static_cast<float>(key[k]);
  }
}

}  // namespace episcope::scenes
