// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/calibrate.h"
#include "engine/capture/photograph.h"
#include "engine/capture/solve_pose.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"

#include <filesystem>
#include <vector>

namespace episcope::capture {

/// Size, errors and seed of the demo gantry.
struct DemoOptions {
  GridShape grid{5, 5};
  int height = 360;
  int width = 480;
  int detail = 120;        ///< Of the mesh (mesh_file.h).
  double jitter_px = 0.3;  ///< Standard deviation of positions, as seen at the middle depth,
  double gain = 0.01;      ///< of gains,
  double noise = 2;        ///< of samples in gray levels,
  double pick_px = 0.5;    ///< and of picks.
  unsigned seed = 1;
};

/// A gantry whose truth is known: camera, positions and pose of the scan. Lengths in mm, Z from 720
/// to 1020 mm.
struct DemoRig {
  LensCamera camera;  ///< With a radial distortion k1 = −0.1.
  double step = 12;   ///< mm
  GridShape grid;
  RigidPose pose;                   ///< Of the scan in the frame of the gantry.
  std::vector<Exposure> exposures;  ///< View by view; turned by 0.4° against the gantry.
};

[[nodiscard]] DemoRig demo_rig(const DemoOptions& options);

/// Pixel of the center photograph that shows a point of the scan.
[[nodiscard]] PlanePoint photographed(const DemoRig& rig, const Exposure& exposure,
                                      const Point3& on_scan);

/// Picks the landmarks of the scan that the center photograph shows, with noise.
[[nodiscard]] std::vector<PointPair> demo_picks(const DemoRig& rig, const TriangleMesh& mesh,
                                                const DemoOptions& options);

/// The photograph that the demo gantry takes of one view. Throws Cancelled.
[[nodiscard]] Image<std::uint8_t> demo_photograph(const DemoRig& rig, const TriangleMesh& mesh,
                                                  ViewIndex view, const Progress& progress);

/// The photographs of all views, as a light field that is not rectified. Throws Cancelled.
[[nodiscard]] LightField demo_photographs(const DemoRig& rig, const TriangleMesh& mesh,
                                          const Progress& progress);

/// The distance of neighboring corners of the demo's calibration pattern, in mm.
[[nodiscard]] Pattern demo_pattern();

/// Writes the input for the way from photographs to a light field with truth:
/// photographs/RR_CC.png, pattern/01.png … (the last two blurred and cut off), mesh.ply (with a
/// hole), picks.csv (in the photograph of the center), readme.txt with the commands. Throws
/// IoError, also if the folder exists and is not empty; Cancelled.
void write_demo_folder(const std::filesystem::path& folder, const DemoOptions& options,
                       const Progress& progress);

}  // namespace episcope::capture
