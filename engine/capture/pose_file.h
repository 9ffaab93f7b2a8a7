// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/solve_pose.h"
#include "engine/core/camera_grid.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace episcope::capture {

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

/// Atomic. Throws IoError.
void write_pose(const std::filesystem::path& path, const PoseStory& story);

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
