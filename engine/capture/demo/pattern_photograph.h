// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/calibrate/pattern.h"
#include "engine/capture/demo/photograph.h"

namespace episcope::capture {

/// A calibration pattern as it is printed, 8 bit grey, with a white margin of half a square at
/// least; `pixels_per_square` as asked for. Throws Unavailable for ChArUco in a build without it.
[[nodiscard]] Image<std::uint8_t> pattern_picture(const Pattern& pattern, int pixels_per_square);

/// A photograph, grey, of a printed pattern: its upper left corner lies at the origin of `pose`, x
/// to the right and y downwards on it. Around it is grey.
[[nodiscard]] Image<std::uint8_t> pattern_photograph(const Pattern& pattern, const RigidPose& pose,
                                                     const LensCamera& camera,
                                                     const Exposure& exposure);

/// Poses of a pattern before a camera at about `distance`, tilted in several directions.
[[nodiscard]] std::vector<RigidPose> pattern_poses(const Pattern& pattern, double distance,
                                                   int count);

}  // namespace episcope::capture
