// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/pose/point_pair.h"
#include "engine/core/light_field/camera_grid.h"

#include <array>
#include <span>

namespace episcope::capture {

/// Where a pose projects the point of a pair, minus where it was picked, in px. NaN for a point
/// behind the camera.
[[nodiscard]] std::array<double, 2> reprojection_residual(const PointPair& pair,
                                                          const RigidPose& pose,
                                                          const Pinhole& pinhole);

/// The sum of Huber's function of the residuals, of `threshold_px`, and of the squares (halved) of
/// locked pairs; infinite if a point lies behind the camera.
[[nodiscard]] double huber_cost(std::span<const PointPair> pairs, const RigidPose& pose,
                                const Pinhole& pinhole, double threshold_px);

struct MinimisedPose {
  RigidPose pose;
  double cost = 0;
  int iterations = 0;
  /// Inverse of the weighted JᵀJ for a standard deviation of 1 px, row by row: rotation vector
  /// (radian, in the frame of the camera), then translation.
  std::array<double, 36> unit_covariance{};
};

/// Levenberg and Marquardt on the reprojection error with Huber's weights and the analytic
/// Jacobian, from `start`; ends when a step is below 1e-12 of the pose, after 100 iterations at
/// most. λ begins at 1e-3 and changes by factors of 10.
[[nodiscard]] MinimisedPose minimise_reprojection(std::span<const PointPair> pairs,
                                                  const RigidPose& start, const Pinhole& pinhole,
                                                  double threshold_px);

}  // namespace episcope::capture
