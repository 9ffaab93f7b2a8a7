// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/calibrate.h"
#include "engine/capture/camera.h"
#include "engine/capture/solve_pose.h"
#include "engine/capture/view_surface.h"
#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace episcope::capture {

/// Position of a camera and errors of its sensor.
struct Exposure {
  double x = 0;  ///< In the frame of the gantry, in the unit of the mesh.
  double y = 0;
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< Camera to gantry, row by row.
  double gain = 1;
  double noise = 0;  ///< Standard deviation in gray levels.
  unsigned seed = 1;
};

/// Takes an RGB photograph of a scene in the frame of the gantry, through a lens: rasterized three
/// times as fine (view_surface.h), distorted by the lens and averaged over each pixel. The texture
/// is noise in space, so it sticks to the surface. Deterministic. Throws Cancelled.
[[nodiscard]] Image<std::uint8_t> photograph(const PlacedScene& scene, const LensCamera& camera,
                                             const Exposure& exposure, const Progress& progress);

/// Adds Gaussian noise of a seed to samples, and rounds them.
[[nodiscard]] Image<std::uint8_t> exposed(const Image<float>& light, const Exposure& exposure);

/// A calibration pattern as it is printed, 8 bit gray, with a white margin of half a square at
/// least; `pixels_per_square` as asked for. Throws Unavailable for ChArUco in a build without it.
[[nodiscard]] Image<std::uint8_t> pattern_picture(const Pattern& pattern, int pixels_per_square);

/// A photograph, gray, of a printed pattern: its upper left corner lies at the origin of `pose`, x
/// to the right and y downwards on it. Around it is gray.
[[nodiscard]] Image<std::uint8_t> pattern_photograph(const Pattern& pattern, const RigidPose& pose,
                                                     const LensCamera& camera,
                                                     const Exposure& exposure);

/// Poses of a pattern before a camera at about `distance`, tilted in several directions.
[[nodiscard]] std::vector<RigidPose> pattern_poses(const Pattern& pattern, double distance,
                                                   int count);

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
