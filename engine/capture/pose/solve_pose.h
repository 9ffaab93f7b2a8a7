// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/pose/point_pair.h"
#include "engine/core/light_field/camera_grid.h"

#include <array>
#include <span>
#include <vector>

namespace episcope::capture {

struct PairResidual {
  double residual_px = 0;   ///< Distance of the pick from where the pose projects its point.
  bool is_outlier = false;  ///< Probably a wrong pick.
};

struct SolvedPose {
  RigidPose pose;
  std::vector<PairResidual> pairs;   ///< As given.
  double reprojection_error_px = 0;  ///< Mean over the pairs that are no outliers.
  /// Of rotation vector (radian) and translation, in the frame of the camera, row by row, from the
  /// residuals; with 4 pairs from the reprojection error that the paper states (0.5 px).
  std::array<double, 36> covariance{};
  double delta_tz = 0;     ///< Δtz in the unit of the mesh,
  double delta_tz_px = 0;  ///< and in px of disparity, NaN if the step of the grid is not known.
};

/// The pose of a mesh from at least 4 pairs: the best of several starts (pose_start.h), then
/// Levenberg and Marquardt with Huber's weights of 2 px. Pairs off by more than 3 px and 5 times
/// the median residual are outliers, unless they are locked, as long as 4 remain; the pose is then
/// that of the others.
/// Δtz = Zc·Δu/|u − cx|, the least over pairs and both axes, with Δu = the reprojection error.
/// Source: [WMG13] section 3.2.1. Throws InvalidInput for fewer than 4 pairs, for points on a line,
/// if there is no pose, and if only the mirror image of the mesh fits.
[[nodiscard]] SolvedPose solve_pose(std::span<const PointPair> pairs, const CameraGrid& camera);

}  // namespace episcope::capture
