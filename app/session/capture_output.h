// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/capture_work.h"
#include "engine/capture/camera.h"
#include "engine/capture/triangle_mesh.h"
#include "engine/core/estimate.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"

#include <filesystem>
#include <memory>
#include <span>

namespace episcope {

/// A mesh and its pose before the cameras.
struct PosedMesh {
  std::shared_ptr<const capture::TriangleMesh> mesh;
  capture::RigidPose pose;
};

/// The disparity of meshes in the center view, as a result to be drawn and compared. Throws what
/// capture::visible_depth does.
[[nodiscard]] Estimate mesh_estimate(std::span<const PosedMesh> meshes, const Scene& scene,
                                     const Progress& progress);

/// The scene with the depth of meshes in all views as its ground truth, and as labels which mesh is
/// seen, from 1 on. Throws as `mesh_estimate`.
[[nodiscard]] Scene with_mesh_truth(std::span<const PosedMesh> meshes, const Scene& scene,
                                    const Progress& progress);

/// Photographs of a gantry and where the light field made of them goes.
struct RectifyTask {
  Scene photographs;
  CaptureWork work;              ///< With lens and settings; pairs in the center photograph.
  std::filesystem::path output;  ///< Light field to write.
};

struct RectifiedFile {
  capture::Rectified rectified;
  /// Work on the new light field: pairs in its center view, how well rows are aligned, no poses.
  CaptureWork work;
};

/// Rectifies photographs and writes the light field. Precondition: there is a lens. Throws what
/// capture::rectify and io::write_archive do.
[[nodiscard]] RectifiedFile rectify_to_file(RectifyTask task, const Progress& progress);

}  // namespace episcope
