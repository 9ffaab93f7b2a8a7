// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/camera_grid.h"
#include "engine/core/disparity_field.h"

#include <cstddef>

namespace episcope::io {

/// Camera that turns a depth map into a disparity map: d = a/Z − b.
struct DepthFit {
  double a = 0;            ///< B·f: px · unit of depth. Negative if disparity grows with depth.
  double b = 0;            ///< Δx: px.
  double exact_share = 0;  ///< Of the pixels, that agree within 0.01 px.
  std::size_t pixels = 0;

  /// Whether the two maps state the same geometry. Far depth may be cut off (a sky), so not all
  /// pixels need to agree.
  [[nodiscard]] bool is_exact() const { return pixels >= 100 && exact_share > 0.9 && a != 0; }
  /// Camera with B = a and f = 1. Precondition: `a` > 0.
  [[nodiscard]] CameraGrid camera() const;
};

/// Fits the camera by least squares over pixels that are valid in both maps and agree with the best
/// line through a pair of them (RANSAC, seeded). `factor` is applied to the disparity.
/// Precondition: maps of one size.
[[nodiscard]] DepthFit fit_depth(const DisparityView& disparity, double factor,
                                 const DisparityView& depth);

}  // namespace episcope::io
