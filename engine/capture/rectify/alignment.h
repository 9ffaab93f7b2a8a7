// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera/lens.h"
#include "engine/capture/rectify/match_views.h"

#include <array>
#include <vector>

namespace episcope::capture {

/// The small correction that a view needs beside the common rotation: by how many px a point is off
/// from where the grid says, a homography to first order, in x and y of the ray (x, y, 1).
struct ViewCorrection {
  std::array<double, 8> parameters{};
  [[nodiscard]] PlanePoint at(double x, double y) const {
    const auto& h = parameters;
    const double bend = h[6] * x + h[7] * y;
    return {h[0] + h[1] * x + h[2] * y + bend * x, h[3] + h[4] * x + h[5] * y + bend * y};
  }
};

/// How photographs turn into a rectified light field.
struct Alignment {
  /// Turns rays of the camera into those of a camera whose axes are those of the gantry, row by
  /// row.
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  double focal_px = 0;  ///< Of that camera; its principal point is that of the lens.
  std::vector<ViewCorrection> corrections;  ///< Row by row.
  std::vector<double> parallax;             ///< Of each point, px per view step, before any shift.
  double residual_px = 0;                   ///< Median distance of matches from the model.

  /// Angle of the rotation in degrees about the optical axis.
  [[nodiscard]] double roll_degrees() const;
};

/// Finds the rotation between camera and gantry with which all points move along rows and columns
/// by the same parallax, and what each view is off, robustly (Huber, 0.3 px). The corrections have
/// no trend along rows or columns: that would be parallax. Throws InvalidInput if the matches do
/// not fit a grid.
[[nodiscard]] Alignment align(const ViewMatches& matches, const LensCamera& camera);

}  // namespace episcope::capture
