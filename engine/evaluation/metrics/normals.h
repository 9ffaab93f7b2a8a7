// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/light_field/camera_grid.h"

namespace episcope {

/// Angle in degrees between the surface normals of two disparity maps of the same size, NaN where
/// one of them has no normal. Normals come from depth by Scharr's kernel with wrapped borders, on
/// points (x, y)·Z as the 2016 benchmark places them: the origin is the first pixel and half the
/// sensor spans the image. Source: Honauer et al. 2016 [HJKG16], evaluation toolkit.
/// `camera.focal_length` below 32 is in units of the larger side, as archive files store it, else
/// in px. Precondition: `camera.is_known()`.
[[nodiscard]] Image<float> angle_between_normals(const Image<double>& a, const Image<double>& b,
                                                 const CameraGrid& camera);

}  // namespace episcope
