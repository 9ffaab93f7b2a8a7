// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

namespace episcope {

/// The pinhole of the center view: a point (X, Y, Z) is seen at (f·X/Z + cx, f·Y/Z + cy), in pixels
/// whose centers have whole coordinates.
struct Pinhole {
  double focal_px = 0;
  double center_x = 0;
  double center_y = 0;
};

/// The camera grid that turns depth into disparity and back: parallel cameras on an equidistant
/// square grid, rectified onto a plane of zero disparity.
///
/// d = B·f/Z − Δx, with d in px per view step (positive = nearer than the plane of zero disparity)
/// and Z the orthogonal distance to the image plane, in units of the scene.
/// Source: Wanner, Meister, Goldluecke 2013, eq. (1) and (2) [WMG13].
struct CameraGrid {
  double baseline = 0;      ///< B (`dH`); with `focal_length` in units of B·f = px · depth unit.
  double focal_length = 0;  ///< f (`focalLength`).
  double shift = 0;         ///< Δx in px per view step (`shift`).
  std::optional<double> cam_distance{};  ///< Z0, where d = 0 (`camDistance`, Blender scenes).
  std::optional<Pinhole> pinhole{};      ///< Known of rectified photographs.

  /// Whether depth and disparity can be converted into each other.
  [[nodiscard]] bool is_known() const { return baseline * focal_length > 0; }
  /// NaN for a depth that is not positive and finite: no surface there.
  [[nodiscard]] double disparity_from_depth(double depth) const;
  /// NaN where d + Δx ≤ 0: no point in front of the camera has that disparity.
  [[nodiscard]] double depth_from_disparity(double disparity_px) const;
};

/// Parameters of a Blender camera grid, eq. (2). The published formula for the shift lacks xRes;
/// d(Z0) must be 0, so shift = dH·f/Z0, which a real file of the archive confirms.
struct BlenderCamera {
  double camera_distance_step = 0;  ///< b, distance of neighboring cameras in scene units.
  double field_of_view = 0;         ///< fov in radian over the larger image side.
  double origin_distance = 0;       ///< Z0.
  int width = 0;                    ///< xRes.
};

/// Throws InvalidInput unless every parameter is positive.
[[nodiscard]] CameraGrid camera_grid_from_blender(const BlenderCamera& camera);

/// Parameters of the 2016 benchmark's `parameters.cfg`.
struct BenchmarkCamera {
  double focal_length_mm = 0;
  double sensor_size_mm = 0;  ///< Of the larger image side.
  double baseline_mm = 0;
  double focus_distance_m = 0;
  int larger_side_px = 0;  ///< max(width, height).
};

/// Camera grid by eq. (1): B·f = β/sensor and Δx = β/(F·sensor), with β =
/// baseline·focal_length·side and F the focus distance in mm (Honauer et al. 2016 [HJKG16]). Z is
/// then in mm. Throws InvalidInput unless every parameter is positive.
[[nodiscard]] CameraGrid camera_grid_from_benchmark(const BenchmarkCamera& camera);

}  // namespace episcope
