// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/view_surface.h"
#include "engine/core/ground_truth.h"

namespace episcope::capture {

/// The cameras of a rectified light field.
struct DepthGrid {
  GridShape grid;
  int height = 0;
  int width = 0;
  CameraGrid camera;  ///< With its pinhole; `baseline` = step of the gantry in the unit of the
                      ///< mesh, `focal_length` = the pinhole's in px.
};

struct DepthOptions {
  double jump_px =
      0.1;  ///< Least difference of disparity across a discontinuity, px per view step.
  bool both_sides = false;  ///< Faces are not oriented: both sides count as outside.
};

/// The camera of one view.
[[nodiscard]] ViewCamera view_camera(const DepthGrid& grid, ViewIndex view);

/// Disparity (eq. 1) of the triangle that decides each pixel of each view, and its mesh as a label,
/// from 1 on; 0 = none. Pixels on silhouettes, on discontinuities of at least `jump_px`, at holes
/// and without a mesh are invalid. Source: [WMG13] section 3.2.1. Throws InvalidInput if the camera
/// is unknown, if no mesh is in front of it, or if almost all surfaces are seen from inside;
/// Cancelled.
[[nodiscard]] GroundTruth visible_depth(std::span<const PlacedMesh> meshes, const DepthGrid& grid,
                                        const DepthOptions& options, const Progress& progress);

}  // namespace episcope::capture
