// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/pose/point_pair.h"
#include "engine/core/light_field/camera_grid.h"

#include <optional>
#include <span>
#include <vector>

namespace episcope::capture {

/// How points of a mesh lie.
enum class PointLayout { Line, Plane, Space };

/// By the singular values of their places: a direction counts from 1 % of the longest.
[[nodiscard]] PointLayout layout_of(std::span<const PointPair> pairs);

/// A first pose: by the homography of points in a plane (≥ 4), by the direct linear transform of
/// points in space (≥ 6), else (4 or 5 points in space) by SQPnP (Terzakis, Lourakis: A
/// consistently fast and globally optimal solution to the perspective-n-point problem, ECCV 2020).
/// None if the points do not determine one in front of the camera.
[[nodiscard]] std::optional<RigidPose> first_pose(std::span<const PointPair> pairs,
                                                  const Pinhole& pinhole);

/// First poses of all pairs and of subsets of them, so that wrong picks do not spoil all: at most
/// 60 sets of 4, drawn by a fixed seed.
[[nodiscard]] std::vector<RigidPose> first_poses(std::span<const PointPair> pairs,
                                                 const Pinhole& pinhole);

}  // namespace episcope::capture
