// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/camera_grid.h"

#include <array>

namespace episcope {

/// Puts the pixels of a view with their disparity into space: x to the right, y up, z towards the
/// viewer (image axes with y and z turned).
///
/// With a known camera, places are in units of the scene: Z by eq. (1) [WMG13], X and Y by the
/// pinhole model, around CameraGrid::pinhole or else the image centre with a focal length of f·xRes
/// px (f is relative to the image width where it is small). Without one, x and y are pixels and z
/// is a multiple of the disparity.
class BackProjection {
 public:
  /// `z_per_px`: z of one px of disparity where the camera is not known.
  BackProjection(const CameraGrid& camera, int height, int width, double z_per_px);

  /// Not finite where no point in front of the camera has that disparity.
  [[nodiscard]] std::array<double, 3> operator()(int y, int x, double disparity_px) const {
    const double right = x - center_x_;
    const double up = center_y_ - y;
    if (!is_metric_) return {right, up, disparity_px * z_per_px_};
    const double depth = camera_.depth_from_disparity(disparity_px);
    return {right * depth / focal_px_, up * depth / focal_px_, -depth};
  }

  /// Whether places are in units of the scene.
  [[nodiscard]] bool is_metric() const { return is_metric_; }

 private:
  CameraGrid camera_;
  bool is_metric_;
  double center_x_;
  double center_y_;
  double focal_px_;
  double z_per_px_;
};

}  // namespace episcope
