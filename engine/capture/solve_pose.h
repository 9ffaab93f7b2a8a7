// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera.h"
#include "engine/core/camera_grid.h"

#include <array>
#include <filesystem>
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

/// Content of a pose file: the pose of a mesh and the pairs it was computed from.
struct PoseStory {
  std::filesystem::path mesh;  ///< Written relative to the pose file where that is possible.
  std::string light_field;     ///< As the user named it.
  CameraGrid camera;
  std::vector<PointPair> pairs;
  SolvedPose solved;
};

/// The text of the file: JSON with mesh, light_field, rotation, translation, reprojection_error_px,
/// delta_tz, delta_tz_px, covariance, pinhole, and pairs (name, x_px, y_px, X, Y, Z, residual_px,
/// outlier, and locked of those that are).
[[nodiscard]] std::string pose_json(const PoseStory& story, const std::filesystem::path& path);

/// Atomic. The path of the mesh is relative to `place`, where the file is to be; empty = `path`.
/// Throws IoError.
void write_pose(const std::filesystem::path& path, const PoseStory& story,
                const std::filesystem::path& place = {});

/// Reads a pose file. It needs mesh, rotation and translation only; the path of the mesh is
/// relative to the file. Throws IoError that names what is missing or wrong.
[[nodiscard]] PoseStory read_pose(const std::filesystem::path& path);

/// Reads pairs as CSV, a line each: name,x_px,y_px,X,Y,Z, and behind them 1 if the pair is locked.
/// A first line that says so, empty lines and lines that begin with # are skipped. Throws IoError,
/// naming the line.
[[nodiscard]] std::vector<PointPair> read_pairs(const std::filesystem::path& path);

/// Writes such a file, so that the numbers are read back exactly; the column of locks only if there
/// are any. Atomic. Throws IoError, also for names with a comma or a line end.
void write_pairs(const std::filesystem::path& path, std::span<const PointPair> pairs);

}  // namespace episcope::capture
