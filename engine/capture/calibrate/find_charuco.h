// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/calibrate/pattern.h"

namespace episcope::capture {

/// Side of a marker on ChArUco boards, in squares.
inline constexpr double kMarkerShare = 0.75;

/// Finds a ChArUco board as `find_pattern` does; the dictionary of its markers is the one of
/// OpenCV's that fits. Throws Unavailable in a build without ArUco.
[[nodiscard]] FoundPattern find_charuco(ImageView<const std::uint8_t> grey, const Pattern& pattern);

/// The picture of a board: `pixels_per_square`, white margin of half a square. Throws Unavailable
/// in a build without ArUco.
[[nodiscard]] Image<std::uint8_t> draw_charuco(const Pattern& pattern, int pixels_per_square);

}  // namespace episcope::capture
