// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera/camera_file.h"

namespace episcope::capture {

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

}  // namespace episcope::capture
