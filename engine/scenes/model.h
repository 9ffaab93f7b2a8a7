// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
  int primitive_count = 0;
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

}  // namespace episcope::scenes
