// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/scenes/model.h"
#include "engine/scenes/sensor.h"

#include <array>
#include <cmath>
#include <vector>

namespace episcope::scenes {

/// A point or a direction: x, y, z.
using Vector3 = std::array<double, 3>;

[[nodiscard]] inline double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
[[nodiscard]] inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
[[nodiscard]] inline Vector3 scaled(const Vector3& a, double factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}
[[nodiscard]] inline double length(const Vector3& a) {
  return std::sqrt(dot(a, a));
}
[[nodiscard]] inline Vector3 normalized(const Vector3& a) {
  return scaled(a, 1 / length(a));
}

/// The cameras for which a scene is laid out. Layouts speak of disparities and pixels of the center
/// view, so that a scene looks alike at every image size.
struct Stage {
  int width = 0;
  int height = 0;
  double focal_px = 0;
  double zero_depth = 10;  ///< Z0: depth of disparity 0.
  double parallax = 60;    ///< B·f in px · depth unit, at disparity scale 1.

  /// Depth of a disparity in px per view step.
  [[nodiscard]] double depth(double disparity_px) const {
    return parallax / (disparity_px + parallax / zero_depth);
  }
  /// Size of a pixel at a depth.
  [[nodiscard]] double pixel(double depth_units) const { return depth_units / focal_px; }
  /// The point seen at pixel (x, y) of the center view.
  [[nodiscard]] Vector3 point(double x, double y, double depth_units) const {
    return {(x - (width - 1) / 2.0) * pixel(depth_units),
            (y - (height - 1) / 2.0) * pixel(depth_units), depth_units};
  }
};

/// A stage with the lens of the built-in scenes.
[[nodiscard]] Stage make_stage(int width, int height);

/// An owned scene, ready to be cast.
struct Model {
  std::vector<Primitive> primitives;
  std::vector<Texture> textures;
  std::vector<Occluder> occluders;
  Lighting lighting;
  Sensor sensor;

  /// Index of the added texture.
  int add(const Texture& texture);
  [[nodiscard]] ModelView view() const;
};

/// Noise of which the finest octave is just resolved where a pixel has size `pixel_units`, around
/// `color`, of `contrast` between 0 and 1.
[[nodiscard]] Texture noise_texture(double pixel_units, unsigned seed,
                                    const std::array<float, 3>& color, float contrast);

/// Sets the own axes of a primitive, in the camera frame.
void set_axes(Primitive& primitive, const Vector3& x, const Vector3& y, const Vector3& z);

/// Radii of a piece of a surface of revolution at its bottom (y = 0), at half its height and at its
/// top. A parabola of the squared radius lies between.
struct Radii {
  double bottom = 0;
  double middle = 0;
  double top = 0;
};
void revolve(Primitive& piece, double height, const Radii& radii);

/// A pattern along `axes` with the given period, with edges as hard as pixels of size `pixel_units`
/// allow. Its second color is left to the caller.
void set_pattern(Texture& texture, Pattern pattern, double pixel_units, double period,
                 const std::array<Vector3, 2>& axes);

/// A rectangle facing the cameras between two pixels' corners of the center view, at a disparity.
struct Card {
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;
  double disparity_px = 0;
};
[[nodiscard]] Primitive make_card(const Stage& stage, const Card& card);

/// The plane on which the disparity of the center view is `center` + `per_x`·(x − x_c) +
/// `per_y`·(y − y_c), without end.
struct DisparityPlane {
  double center = 0;
  double per_x = 0;
  double per_y = 0;
};
[[nodiscard]] Primitive make_plane(const Stage& stage, const DisparityPlane& plane);

/// Between which depths all of a primitive lies.
[[nodiscard]] Interval depths_of(const Primitive& primitive);

/// Rectangle of pixels of a view that may show a primitive, [x_begin, x_end) × [y_begin, y_end).
struct Bounds {
  int x_begin = 0;
  int x_end = 0;
  int y_begin = 0;
  int y_end = 0;
};
[[nodiscard]] Bounds bounds_in_view(const Primitive& primitive, const ViewCamera& camera, int width,
                                    int height);

}  // namespace episcope::scenes
