// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera.h"
#include "engine/core/camera_grid.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace episcope::capture {

/// A point of the center view and the same point of the mesh, picked by hand.
struct PointPair {
  std::string name;
  double x_px = 0;  ///< Centers of pixels have whole coordinates.
  double y_px = 0;
  Point3 point;            ///< In the frame of the mesh.
  bool is_locked = false;  ///< Never treated as a wrong pick; has full weight.
  friend bool operator==(const PointPair&, const PointPair&) = default;
};

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

/// The pose of a mesh from at least 4 pairs: the best of several starts, then
/// Levenberg and Marquardt with Huber's weights of 2 px. Pairs off by more than 3 px and 5 times
/// the median residual are outliers, unless they are locked, while 4 pairs remain. Outliers do not
/// influence the pose.
/// Δtz = Zc·Δu/|u − cx|, the least over pairs and both axes, with Δu = the reprojection error.
/// Source: [WMG13] section 3.2.1. Throws InvalidInput for fewer than 4 pairs, for points on a line,
/// if there is no pose, and if only the mirror image of the mesh fits.
[[nodiscard]] SolvedPose solve_pose(std::span<const PointPair> pairs, const CameraGrid& camera);

/// Where a pose projects the point of a pair, minus where it was picked, in px. NaN for a point
/// behind the camera.
[[nodiscard]] std::array<double, 2> reprojection_residual(const PointPair& pair,
                                                          const RigidPose& pose,
                                                          const Pinhole& pinhole);

/// The sum of Huber's function of the residuals, of `threshold_px`, and of the squares (halved) of
/// locked pairs; infinite if a point lies behind the camera.
[[nodiscard]] double huber_cost(std::span<const PointPair> pairs, const RigidPose& pose,
                                const Pinhole& pinhole, double threshold_px);

struct MinimizedPose {
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
[[nodiscard]] MinimizedPose minimize_reprojection(std::span<const PointPair> pairs,
                                                  const RigidPose& start, const Pinhole& pinhole,
                                                  double threshold_px);

}  // namespace episcope::capture
