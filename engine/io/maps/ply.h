// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/camera_grid.h"
#include "engine/core/light_field/disparity_field.h"

#include <cstdint>
#include <filesystem>

namespace episcope::io {

/// A point cloud of one view: the valid pixels of `disparity`, coloured by `rgb` (same size, 3 or 1
/// channels).
struct PointCloud {
  DisparityView disparity;
  ImageView<const std::uint8_t> rgb;
  CameraGrid camera;  ///< Not known: z = −stretch·d in pixels of the image plane.
  bool binary = true;
};

/// Writes PLY, axes (x, −y, −z): x to the right, y upwards, the viewer looks along −z.
/// Atomic. Throws IoError, InvalidInput if no pixel is valid.
void write_ply(const std::filesystem::path& path, const PointCloud& cloud);

}  // namespace episcope::io
