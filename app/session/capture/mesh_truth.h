// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera/rigid_pose.h"
#include "engine/capture/mesh/triangle_mesh.h"
#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"

namespace episcope {

/// The disparity of a mesh in the centre view, as a result to be drawn and compared. Throws what
/// capture::visible_depth does.
[[nodiscard]] Estimate mesh_estimate(const capture::TriangleMesh& mesh,
                                     const capture::RigidPose& pose, const Scene& scene,
                                     const Progress& progress);

/// The scene with the depth of a mesh in all views as its ground truth, and its label. Throws
/// likewise.
[[nodiscard]] Scene with_mesh_truth(const capture::TriangleMesh& mesh,
                                    const capture::RigidPose& pose, const Scene& scene,
                                    const Progress& progress);

}  // namespace episcope
