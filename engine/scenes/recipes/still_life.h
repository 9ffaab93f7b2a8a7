// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/scenes/recipes/stage.h"

namespace episcope::scenes {

/// Where something stands on the table: `x` to the right, `y` above the table, `z` away from the
/// cameras, in scene units; turned by `turn` (cosine and sine) about the upright axis.
struct Place {
  double x = 0;
  double y = 0;
  double z = 0;
  std::array<double, 2> turn{1, 0};
};

/// Builds scenes of things on a table, which the cameras look down on.
class StillLife {
 public:
  /// The lower edge of the image shows the table at `front_disparity`. `pitch` is cosine and sine
  /// of the angle by which the cameras look down.
  StillLife(const Stage& stage, std::array<double, 2> pitch, double front_disparity);

  void table(const Texture& texture, int label);
  void wall(double z, const Texture& texture, int label);
  /// `place` is the middle of the bottom.
  void box(const Place& place, const Vector3& half, const Texture& texture, int label);
  void sphere(const Place& center, double radius, const Texture& texture, int label);
  /// A piece of a surface of revolution, see `revolve`.
  void surface_of_revolution(const Place& place, double height, const Radii& radii, int texture,
                             int label);
  void disc(const Place& center, double radius, int texture, int label);
  /// A thin rod between two points.
  void rod(const Place& from, const Place& to, double radius, int texture, int label);
  void occluder(const Place& center, double radius, int label);

  /// Size of a pixel of the centre view at a place.
  [[nodiscard]] double pixel_at(const Place& place) const;
  /// Noise that is resolved there, and fades where it is not.
  [[nodiscard]] Texture noise_at(const Place& place, unsigned seed,
                                 const std::array<float, 3>& color, float contrast) const;
  /// A pattern along `axis` with the given period, with edges as hard as pixels there allow.
  void add_pattern(Texture& texture, Pattern pattern, const Place& place, double period,
                   const std::array<Vector3, 2>& axes) const;
  void light(const Lighting& lighting, const Vector3& key_direction);

  [[nodiscard]] Model& model() { return model_; }

 private:
  [[nodiscard]] Vector3 direction(const Vector3& room) const;
  [[nodiscard]] Vector3 position(const Place& place) const;
  Primitive& add(Shape shape, const Place& place, int texture, int label);

  Stage stage_;
  std::array<double, 2> pitch_;
  double table_y_ = 0;  // Of the table, from the cameras.
  double front_z_ = 0;  // Of the lower edge of the image, from the cameras.
  Model model_;
};

}  // namespace episcope::scenes
