// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/calibrate.h"
#include "engine/capture/camera.h"
#include "engine/capture/view_surface.h"
#include "engine/core/image.h"
#include "engine/core/progress.h"

#include <array>
#include <cstdint>

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

/// Position of sample `i` of a pixel with `along`² samples on a regular grid, row by row.
[[nodiscard]] PlanePoint sample_of_pixel(int y, int x, int along, int i);

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

}  // namespace episcope::capture
