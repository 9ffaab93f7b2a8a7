// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/metrics/normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace episcope {
namespace {

using Vector = std::array<double, 3>;

/// Position of a pixel's surface point per unit of depth.
struct PointGrid {
  double x_step = 0;
  double y_step = 0;

  PointGrid(const CameraGrid& camera, int height, int width) {
    constexpr double least_focal_px = 32;
    const double side = std::max(height, width);
    const double sensor_per_focal =
        camera.focal_length < least_focal_px ? 1 / camera.focal_length : side / camera.focal_length;
    x_step = 0.5 * sensor_per_focal / std::max(1, width - 1);
    y_step = 0.5 * sensor_per_focal / std::max(1, height - 1);
  }
};

Image<double> depth_map(const Image<double>& disparity, const CameraGrid& camera) {
  Image<double> depth(disparity.height(), disparity.width());
  std::transform(disparity.begin(), disparity.end(), depth.begin(),
                 [&](double d) { return camera.depth_from_disparity(d); });
  return depth;
}

Vector normal(const Image<double>& depth, const PointGrid& grid, int y, int x) {
  Vector along_x{};
  Vector along_y{};
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      const double weight_x = (j == 0 ? 10 : 3) * i;
      const double weight_y = (i == 0 ? 10 : 3) * j;
      const int yy = (y + j + depth.height()) % depth.height();
      const int xx = (x + i + depth.width()) % depth.width();
      const double z = depth.at(yy, xx);
      const Vector point{grid.x_step * xx * z, grid.y_step * yy * z, z};
      for (int k = 0; k < 3; ++k) {
        along_x[k] += weight_x * point[k];
        along_y[k] += weight_y * point[k];
      }
    }
  }
  Vector cross{along_x[1] * along_y[2] - along_x[2] * along_y[1],
               along_x[2] * along_y[0] - along_x[0] * along_y[2],
               along_x[0] * along_y[1] - along_x[1] * along_y[0]};
  const double length = std::hypot(cross[0], cross[1], cross[2]);
  for (double& component : cross) component /= length;
  return cross;
}

}  // namespace

Image<float> angle_between_normals(const Image<double>& a, const Image<double>& b,
                                   const CameraGrid& camera) {
  const PointGrid grid(camera, a.height(), a.width());
  const Image<double> depth_a = depth_map(a, camera);
  const Image<double> depth_b = depth_map(b, camera);
  Image<float> angle(a.height(), a.width());
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const Vector na = normal(depth_a, grid, y, x);
      const Vector nb = normal(depth_b, grid, y, x);
      const double cosine = na[0] * nb[0] + na[1] * nb[1] + na[2] * nb[2];
      const double bounded = std::clamp(cosine, -1.0, 1.0);
      angle.at(y, x) = static_cast<float>(std::acos(bounded) * 180 / std::numbers::pi);
    }
  }
  return angle;
}

}  // namespace episcope
