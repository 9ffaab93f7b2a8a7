// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera.h"
#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/core/schema.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
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

/// A photograph of a pattern and its use in the calibration.
struct PatternPhotograph {
  std::string name;
  FoundPattern found;
  double sharpness = 0;  ///< As `sharpness` says.
  double rms = 0;        ///< Reprojection error in px, if it is used.
  std::string problem;   ///< Why it was left out, as part of a sentence; empty = used.

  [[nodiscard]] bool is_used() const { return problem.empty(); }
};

struct Calibration {
  LensCamera camera;
  std::vector<PatternPhotograph> photographs;  ///< As given.
};

/// Calibrates a camera from patterns found on photographs of `width`×`height` px. Leaves out
/// photographs without the pattern, with edges twice as wide as the median, or with an error of
/// more than three times the median. Zhang's method in OpenCV, with k1, k2, p1, p2, k3. Throws
/// InvalidInput if fewer than 3 photographs remain, with the problem of each.
[[nodiscard]] Calibration calibrate(std::vector<PatternPhotograph> photographs, int height,
                                    int width);

/// Reads the files and calibrates. Photographs of another size than most
/// are left out; of sizes that are equally frequent, the one that comes first counts. Throws
/// IoError for a file that cannot be read, InvalidInput as above, Cancelled.
[[nodiscard]] Calibration calibrate(const std::vector<std::filesystem::path>& files,
                                    const Pattern& pattern, const Progress& progress);

/// Steepness of the edges around points: the steepest change between neighboring pixels within
/// `reach` px of a point, divided by the contrast there, averaged over the points. About 0.5 … 1
/// for sharp photographs, 1/w for edges that are w px wide. The lesser of the changes across and
/// down counts, because a moving camera blurs in one direction.
[[nodiscard]] double sharpness(ImageView<const std::uint8_t> gray,
                               std::span<const std::array<double, 2>> points, int reach);

}  // namespace episcope::capture
