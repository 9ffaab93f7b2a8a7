// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera/rigid_pose.h"
#include "engine/capture/mesh/triangle_mesh.h"
#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"

#include <memory>
#include <span>

namespace episcope {

/// A mesh before the cameras.
struct PosedMesh {
  std::shared_ptr<const capture::TriangleMesh> mesh;
  capture::RigidPose pose;
};

/// The disparity of meshes in the centre view, as a result to be drawn and compared. Throws what
/// capture::visible_depth does.
[[nodiscard]] Estimate mesh_estimate(std::span<const PosedMesh> meshes, const Scene& scene,
                                     const Progress& progress);

/// The scene with the depth of meshes in all views as its ground truth, and as labels which mesh is
/// seen, from 1 on. Throws likewise.
[[nodiscard]] Scene with_mesh_truth(std::span<const PosedMesh> meshes, const Scene& scene,
                                    const Progress& progress);

}  // namespace episcope
