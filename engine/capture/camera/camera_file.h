// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>

namespace episcope::capture {

/// A camera as OpenCV models it: pixels (fx·x' + cx, fy·y' + cy), whose centres have whole
/// coordinates, of rays (x, y, 1) bent by the lens to (x', y').
struct LensCamera {
  int width = 0;  ///< Of a photograph, in px,
  int height = 0;
  double focal_x = 0;  ///< fx, fy in px,
  double focal_y = 0;
  double center_x = 0;  ///< cx, cy in px.
  double center_y = 0;
  std::array<double, 5> distortion{};  ///< k1, k2, p1, p2, k3.
  double rms = 0;                      ///< Reprojection error of the calibration in px.
  friend bool operator==(const LensCamera&, const LensCamera&) = default;
};

/// Writes a camera as YAML that cv::FileStorage reads, with OpenCV's usual names: image_width,
/// image_height, camera_matrix, distortion_coefficients, avg_reprojection_error. Atomic. Throws
/// IoError.
void write_camera(const std::filesystem::path& path, const LensCamera& camera);

/// Reads such a file, of Episcope or of OpenCV's own programs. Throws IoError.
[[nodiscard]] LensCamera read_camera(const std::filesystem::path& path);

}  // namespace episcope::capture
