// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/schema.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace episcope::capture {

enum class PatternKind { Chessboard, Charuco, Circles };

/// "chessboard", "charuco", "circles".
[[nodiscard]] Names<PatternKind> names_of(PatternKind);

/// A calibration pattern, flat.
struct Pattern {
  PatternKind kind = PatternKind::Chessboard;
  int columns = 9;  ///< Inner corners of a chessboard or ChArUco board, circles of a grid.
  int rows = 6;
  double square = 1;  ///< Distance of neighboring points, in any unit.
  friend bool operator==(const Pattern&, const Pattern&) = default;
};

[[nodiscard]] Schema<Pattern> pattern_schema();

/// Points of a pattern found on a photograph.
struct FoundPattern {
  std::vector<std::array<double, 2>> pixels;  ///< Centers of pixels have whole coordinates.
  std::vector<std::array<double, 2>> points;  ///< On the pattern, in its unit; one for each pixel.
  std::string problem;  ///< Why it was not found, as part of a sentence; empty = found.
};

/// Finds the pattern to sub-pixel precision. `gray`: 8 bit, 1 channel. Of chessboards and circles
/// all points must be seen, of ChArUco boards a quarter. Throws Unavailable for ChArUco in a build
/// without ArUco.
[[nodiscard]] FoundPattern find_pattern(ImageView<const std::uint8_t> gray, const Pattern& pattern);

/// Side of a marker on ChArUco boards, in squares.
inline constexpr double kMarkerShare = 0.75;

/// Finds a ChArUco board as `find_pattern` does; the dictionary of its markers is the one of
/// OpenCV's that fits. Throws Unavailable in a build without ArUco.
[[nodiscard]] FoundPattern find_charuco(ImageView<const std::uint8_t> gray, const Pattern& pattern);

/// The picture of a board: `pixels_per_square`, white margin of half a square. Throws Unavailable
/// in a build without ArUco.
[[nodiscard]] Image<std::uint8_t> draw_charuco(const Pattern& pattern, int pixels_per_square);

}  // namespace episcope::capture
