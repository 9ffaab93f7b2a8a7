// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/camera_grid.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace episcope {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

void require_positive(double value, const char* name) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw InvalidInput(
        fmt::format("the camera parameter {} is {:f}, but must be positive", name, value));
  }
}

}  // namespace

double CameraGrid::disparity_from_depth(double depth) const {
  if (!(depth > 0) || !std::isfinite(depth)) return kNoValue;
  return baseline * focal_length / depth - shift;  // eq. 1
}

double CameraGrid::depth_from_disparity(double disparity_px) const {
  const double from_infinity = disparity_px + shift;
  if (!(from_infinity > 0) || !std::isfinite(from_infinity)) return kNoValue;
  return baseline * focal_length / from_infinity;
}

CameraGrid camera_grid_from_blender(const BlenderCamera& camera) {
  require_positive(camera.camera_distance_step, "b");
  require_positive(camera.field_of_view, "fov");
  require_positive(camera.origin_distance, "Z0");
  require_positive(camera.width, "xRes");
  CameraGrid grid;
  grid.baseline = camera.camera_distance_step * camera.width;  // eq. 2
  grid.focal_length = 1 / (2 * std::tan(camera.field_of_view / 2));
  grid.shift = grid.baseline * grid.focal_length / camera.origin_distance;
  grid.cam_distance = camera.origin_distance;
  return grid;
}

CameraGrid camera_grid_from_benchmark(const BenchmarkCamera& camera) {
  require_positive(camera.focal_length_mm, "focal_length_mm");
  require_positive(camera.sensor_size_mm, "sensor_size_mm");
  require_positive(camera.baseline_mm, "baseline_mm");
  require_positive(camera.focus_distance_m, "focus_distance_m");
  require_positive(camera.larger_side_px, "image_resolution");
  CameraGrid grid;
  grid.baseline = camera.baseline_mm;
  grid.focal_length = camera.focal_length_mm * camera.larger_side_px / camera.sensor_size_mm;
  grid.cam_distance = 1000 * camera.focus_distance_m;
  grid.shift = grid.baseline * grid.focal_length / *grid.cam_distance;
  return grid;
}

}  // namespace episcope
