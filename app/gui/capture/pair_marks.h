// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/mesh_file.h"
#include "engine/capture/solve_pose.h"
#include "widgets/canvas/canvas_geometry.h"
#include "widgets/cloud/cloud_look.h"
#include "widgets/panels/capture_panel.h"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace episcope {

/// Mesh for the 3D view, coarser while it moves. Linear.
[[nodiscard]] CloudPartsPtr mesh_parts(const capture::TriangleMesh& mesh);

/// Mesh point in the coordinates of the 3D view.
[[nodiscard]] std::array<double, 3> in_mesh_view(const capture::Point3& point);

/// Pairs as rows of the table.
[[nodiscard]] std::vector<CaptureRow> pair_rows(const std::vector<capture::PointPair>& pairs,
                                                const std::optional<capture::SolvedPose>& pose);

/// Pairs as marks in view and mesh.
struct PairMarks {
  std::vector<CanvasMark> on_view;  ///< With where the pose puts each, if there is one.
  std::vector<CloudMark> on_mesh;
};

/// Emphasizes the pair at place `is_emphasised`; `pose` may be null.
[[nodiscard]] PairMarks pair_marks(const std::vector<capture::PointPair>& pairs,
                                   const capture::RigidPose* pose,
                                   const std::optional<Pinhole>& pinhole,
                                   const std::function<bool(int)>& is_emphasised);

}  // namespace episcope
