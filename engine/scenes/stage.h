// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace episcope::scenes {

/// The plain data that the ray caster reads. Camera frame of the center view: x right, y down,
/// z forward; lengths in scene units. Nothing here has code, because the caster is compiled once
/// for every instruction set.

enum class Shape {
  Rectangle,  ///< z = 0 in its own frame, |x| ≤ extent[0], |y| ≤ extent[1].
  Disc,       ///< z = 0, x² + y² ≤ extent[0]².
  Leaf,       ///< z = 0, |y| ≤ extent[1]·(1 − (x/extent[0])²): pointed at both ends.
  /// z = 0, |x| ≤ extent[0], |y| ≤ extent[1]·(1 − x/extent[0])/2: its tip lies on +x.
  Triangle,
  /// A Rectangle of bars: upright ones at x = k·profile[0] of half width profile[2], level ones at
  /// y = k·profile[1] of half width extent[2]; a half width below 0 = none of them.
  Lattice,
  Box,  ///< |x|, |y|, |z| ≤ extent.
  /// Surface of revolution about y between extent[0] and extent[1], seen from outside and inside:
  /// x² + z² = profile[0] + profile[1]·y + profile[2]·y². Spheres, cylinders, cones, vases.
  Revolution
};

enum class Pattern { Plain, Stripes, Checker, Rings };

/// Three octaves of value noise with C2 interpolation on an integer lattice, in object coordinates,
/// and a soft pattern between two colors.
struct Texture {
  double spacing[3] = {1, 1, 1};  ///< Lattice spacing of each octave, finest first.
  double stretch[3] = {1, 1, 1};  ///< Factors by which the noise is longer along x, y, z.
  unsigned seed = 0;
  bool is_solid = false;  ///< Noise in x, y, z of the object, else in x, y.
  /// An octave vanishes where its spacing falls below 3.5 px as seen from the center view, so that
  /// slanted surfaces stay free of aliasing; it is whole from 4.5 px on.
  bool fades = false;
  float color[2][3] = {{0.5F, 0.5F, 0.5F}, {0.5F, 0.5F, 0.5F}};
  float gain[3][3] = {};  ///< [octave][channel], added as gain · noise, noise in [−1, 1].
  Pattern pattern = Pattern::Plain;
  double pattern_axis[2][3] = {};  ///< Phase in periods = axis · position.
  double pattern_step = 1;         ///< Length of the transition between the two colors.
  float pattern_sharpness = 1;  ///< Half a period in transitions; 1 = a wave, larger = hard edges.
  float pattern_warp = 0;       ///< Periods by which the coarse noise bends the pattern.
  float gloss = 0;              ///< Strength of the highlight painted on by the key light.
};

struct Primitive {
  Shape shape = Shape::Rectangle;
  double center[3] = {};
  double axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< Rows: own axes in the camera frame.
  double extent[3] = {1, 1, 1};
  double profile[3] = {};
  int label = 1;  ///< Of the object it belongs to.
  int texture = 0;
  bool is_pane = false;  ///< Transparent: half of its color, half of what is behind.
};

/// Darkens what is near it: stands in for an object in the soft shadows.
struct Occluder {
  float center[3] = {};
  float radius = 0;
  int label = 0;  ///< Its own object is not darkened by it.
};

struct Lighting {
  bool is_on = false;  ///< Off: surfaces show their texture as it is.
  float up[3] = {0, -1, 0};
  float sky[3] = {};                    ///< Light on what faces up,
  float ground[3] = {};                 ///< and on what faces down.
  float key[3] = {};                    ///< Of the key light,
  float key_direction[3] = {0, -1, 0};  ///< towards it, of length 1.
  /// Highlights move over the surface with the view, as on polished things; else all views show the
  /// highlights of the center view.
  bool has_moving_highlights = false;
};

/// Borrowed scene.
struct ModelView {
  const Primitive* primitives = nullptr;
  const Texture* textures = nullptr;
  const Occluder* occluders = nullptr;
  int occluder_count = 0;
  Lighting lighting;
};

/// A ray through pixel (x, y) is origin + t·((x − principal[0])/focal_px, (y − principal[1])/
/// focal_px, 1); t is the depth.
struct ViewCamera {
  double origin[3] = {};
  double principal[2] = {};
  double focal_px = 1;
};

/// A primitive that may be seen in columns [begin, end) of a row.
struct Candidate {
  int primitive = 0;
  int begin = 0;
  int end = 0;
};

/// Most primitives of a scene.
inline constexpr int kMaxCandidates = 192;

/// Result of one row of one view. Arrays are as long as the row; `width` is a multiple of 16
/// or padded to it.
struct RowResult {
  float* color = nullptr;    ///< [x][3], mean over the samples of each pixel.
  int* primitive = nullptr;  ///< Nearest opaque one at the pixel center, −1 = none.
  double* depth = nullptr;   ///< Its depth.
  int* pane = nullptr;       ///< Nearest pane before it, −1 = none.
  double* pane_depth = nullptr;
  unsigned char* is_edge = nullptr;  ///< 1 = the samples hit more than one object.
};

struct RowJob {
  ModelView model;
  ViewCamera camera;
  const Candidate* candidates = nullptr;
  int candidate_count = 0;  ///< Up to kMaxCandidates.
  int y = 0;
  int width = 0;   ///< Rounded up to a multiple of 16.
  float fill = 1;  ///< Of a pixel, along each axis: the part that samples cover.
};

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

/// The step of SplitMix64 and its finaliser, which turns counters into random bits (Steele, Lea,
/// Flood 2014): the same on every machine.
inline constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15ULL;

[[nodiscard]] constexpr std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

/// Random draws that depend on the seed alone, on every machine. Draw one number per statement:
/// the order in which arguments are evaluated is not fixed.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : stream_(mix(seed * kGolden + 3)) {}

  /// Draws of their own, so that one more draw here changes nothing there.
  [[nodiscard]] Draw part(std::uint64_t number) const {
    return Draw(mix(stream_ + (number + 1) * 0xD1B54A32D192ED03ULL));
  }

  /// In [0, 1).
  double unit() {
    const std::uint64_t bits = mix(stream_ + ++count_ * kGolden);
    return static_cast<double>(bits >> 11) / 9007199254740992.0;  // 2^53
  }
  /// In [0, 1), small ones more often.
  double small() {
    const double u = unit();
    return u * u;
  }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// From `low` to `high`, both included.
  int integer(int low, int high) { return low + static_cast<int>(unit() * (high - low + 1)); }
  bool chance(double probability) { return unit() < probability; }
  /// −1 or 1.
  double sign() { return chance(0.5) ? 1 : -1; }
  std::uint32_t bits() { return static_cast<std::uint32_t>(mix(stream_ + ++count_ * kGolden)); }

  /// An index, in proportion to the weights.
  template <std::size_t n>
  int weighted(const std::array<double, n>& weights) {
    double total = 0;
    for (const double weight : weights) total += weight;
    double left = unit() * total;
    for (std::size_t i = 0; i < n; ++i) {
      left -= weights[i];
      if (left < 0) return static_cast<int>(i);
    }
    return 0;
  }

 private:
  std::uint64_t stream_;
  std::uint64_t count_ = 0;
};

}  // namespace episcope::scenes
