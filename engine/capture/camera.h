// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>

namespace episcope::capture {

/// A camera as OpenCV models it: pixels (fx·x' + cx, fy·y' + cy), whose centers have whole
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

/// A point of the plane of an image: in px, or as the ray (x, y, 1).
struct PlanePoint {
  double x = 0;
  double y = 0;
};

/// The pixel that a ray meets, through the lens.
[[nodiscard]] inline PlanePoint pixel_of_ray(const LensCamera& camera, const PlanePoint& ray) {
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  const double xx = ray.x * ray.x;
  const double yy = ray.y * ray.y;
  const double xy = ray.x * ray.y;
  const double rr = xx + yy;
  const double radial = 1 + rr * (k1 + rr * (k2 + rr * k3));
  const double x = ray.x * radial + 2 * p1 * xy + p2 * (rr + 2 * xx);
  const double y = ray.y * radial + 2 * p2 * xy + p1 * (rr + 2 * yy);
  return {camera.focal_x * x + camera.center_x, camera.focal_y * y + camera.center_y};
}

/// The ray that meets a pixel, to about 1e-10 for lenses as they are bought: Newton's steps with
/// the slope of an ideal lens.
[[nodiscard]] inline PlanePoint ray_of_pixel(const LensCamera& camera, const PlanePoint& pixel) {
  PlanePoint ray{(pixel.x - camera.center_x) / camera.focal_x,
                 (pixel.y - camera.center_y) / camera.focal_y};
  for (int i = 0; i < 40; ++i) {
    const PlanePoint seen = pixel_of_ray(camera, ray);
    const double dx = (pixel.x - seen.x) / camera.focal_x;
    const double dy = (pixel.y - seen.y) / camera.focal_y;
    ray = {ray.x + dx, ray.y + dy};
    if (dx * dx + dy * dy < 1e-24) break;
  }
  return ray;
}

/// A point in space, in the unit of the mesh.
struct Point3 {
  double x = 0;
  double y = 0;
  double z = 0;
  friend bool operator==(const Point3&, const Point3&) = default;
};

/// The pose of an object: X_camera = R·X_object + t. The frame of the camera has x to the right, y
/// downwards and z forwards; its origin is the pinhole of the center view.
struct RigidPose {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< R row by row.
  std::array<double, 3> translation{};                        ///< t in the unit of the mesh.

  [[nodiscard]] Point3 apply(const Point3& p) const {
    const auto& r = rotation;
    const auto& t = translation;
    return {r[0] * p.x + r[1] * p.y + r[2] * p.z + t[0],
            r[3] * p.x + r[4] * p.y + r[5] * p.z + t[1],
            r[6] * p.x + r[7] * p.y + r[8] * p.z + t[2]};
  }
};

}  // namespace episcope::capture
