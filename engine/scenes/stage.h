// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/scenes/model.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace episcope::scenes {

/// How the cameras turn light into samples; by default exactly.
struct Sensor {
  float exposure = 1;     ///< Factor of all samples; small = a dark scene.
  float vignetting = 0;   ///< Share of the light that is lost in the corners of a view.
  float gain_spread = 0;  ///< Gains of the views lie within 1 ± this; the center view has 1.
  /// Standard deviation of the noise in units of 1/255, at the top of a view and at its bottom.
  float noise_top = 0;
  float noise_bottom = 0;
  /// Side of the part of a pixel that light falls on, px; below 1, detail finer than a pixel is
  /// aliased: it changes from view to view. 0 = a single ray.
  float fill = 1;
};

/// Exposes the rows of all views of one scene.
class Exposure {
 public:
  struct Format {
    int height = 0;
    int width = 0;
    int channels = 3;
    double noise_sigma = 0;  ///< Of further noise, in units of 1/255.
    unsigned seed = 1;       ///< Of noise and gains.
  };
  Exposure(const Sensor& sensor, const Format& format) : sensor_(sensor), format_(format) {}

  /// Row `y` of the view `steps` away from the center view. `rgb`: light, [x][3]; `out`: samples,
  /// [x][channels], of which the first is number `counter` of the light field.
  void write_row(ViewIndex steps, int y, const float* rgb, std::uint64_t counter,
                 std::uint8_t* out) const;

  /// The gain of a view.
  [[nodiscard]] float gain(ViewIndex steps) const;

 private:
  [[nodiscard]] float noise_sigma(int y) const;

  Sensor sensor_;
  Format format_;
};

/// A normally distributed number of variance 1 that depends on `seed` and `counter` alone: the sum
/// of twelve uniform numbers minus six, so that no function of the maths library is involved.
[[nodiscard]] float sensor_noise(unsigned seed, std::uint64_t counter);

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
