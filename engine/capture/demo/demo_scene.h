// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/calibrate/pattern.h"
#include "engine/capture/demo/photograph.h"
#include "engine/capture/pose/point_pair.h"
#include "engine/core/array/indices.h"

#include <vector>

namespace episcope::capture {

/// What happens when a gantry is photographed with, as told by whoever asks.
struct DemoOptions {
  GridShape grid{5, 5};
  int height = 360;
  int width = 480;
  int detail = 120;        ///< Of the mesh (scan_mesh.h).
  double jitter_px = 0.3;  ///< Standard deviation of positions, as seen at the middle depth,
  double gain = 0.01;      ///< of gains,
  double noise = 2;        ///< of samples in grey levels,
  double pick_px = 0.5;    ///< and of picks.
  unsigned seed = 1;
};

/// A gantry whose truth is known: its camera, where it stood, and where the scan lies. Lengths in
/// mm, Z from 720 to 1020 mm.
struct DemoRig {
  LensCamera camera;  ///< With a radial distortion k1 = −0.1.
  double step = 12;   ///< mm
  GridShape grid;
  RigidPose pose;                   ///< Of the scan in the frame of the gantry.
  std::vector<Exposure> exposures;  ///< View by view; turned by 0.4° against the gantry.
};

[[nodiscard]] DemoRig demo_rig(const DemoOptions& options);

/// Where the photograph of the centre shows a point of the scan.
[[nodiscard]] PlanePoint photographed(const DemoRig& rig, const Exposure& exposure,
                                      const Point3& on_scan);

/// Landmarks of the scan picked in the photograph of the centre, as far as they are seen there,
/// with the noise of picks.
[[nodiscard]] std::vector<PointPair> demo_picks(const DemoRig& rig, const TriangleMesh& mesh,
                                                const DemoOptions& options);

}  // namespace episcope::capture
