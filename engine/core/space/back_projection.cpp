// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/space/back_projection.h"

namespace episcope {
namespace {

/// Smaller focal lengths are relative to the image width (eq. 2), larger ones in px: 50 image
/// widths would be a view of one degree, 50 px one of more than 150.
constexpr double kRelativeFocalLength = 50;

Pinhole pinhole_of(const CameraGrid& camera, int height, int width) {
  if (camera.pinhole) return *camera.pinhole;
  const double focal_px = camera.focal_length < kRelativeFocalLength ? camera.focal_length * width
                                                                     : camera.focal_length;
  return {focal_px, (width - 1) / 2.0, (height - 1) / 2.0};
}

}  // namespace

BackProjection::BackProjection(const CameraGrid& camera, int height, int width, double z_per_px)
    : camera_(camera), is_metric_(camera.is_known()), z_per_px_(z_per_px) {
  const Pinhole pinhole = pinhole_of(camera, height, width);
  focal_px_ = pinhole.focal_px;
  center_x_ = pinhole.center_x;
  center_y_ = pinhole.center_y;
}

}  // namespace episcope
