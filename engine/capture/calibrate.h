// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera.h"
#include "engine/capture/pattern.h"
#include "engine/core/image.h"
#include "engine/core/progress.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace episcope::capture {

/// A photograph of a pattern, and what became of it.
struct PatternPhotograph {
  std::string name;
  FoundPattern found;
  double sharpness = 0;  ///< As `sharpness` says.
  double rms = 0;        ///< Reprojection error in px, of those used.
  std::string problem;   ///< Why it was left out, as part of a sentence; empty = used.

  [[nodiscard]] bool is_used() const { return problem.empty(); }
};

struct Calibration {
  LensCamera camera;
  std::vector<PatternPhotograph> photographs;  ///< As given.
};

/// Calibrates from what was found on photographs of `width`×`height` px. Left out are those without
/// the pattern, those whose edges are twice as wide as the median's, and those whose error is more
/// than three times the median's. Zhang's method in OpenCV, with k1, k2, p1, p2, k3. Throws
/// InvalidInput if fewer than 3 photographs remain, naming what is wrong with each.
[[nodiscard]] Calibration calibrate(std::vector<PatternPhotograph> photographs, int height,
                                    int width);

/// Reads the files and calibrates. Photographs of another size than the first are left out. Throws
/// IoError for a file that cannot be read, InvalidInput as above, Cancelled.
[[nodiscard]] Calibration calibrate(const std::vector<std::filesystem::path>& files,
                                    const Pattern& pattern, const Progress& progress);

/// How steep the edges around points are: the steepest change between neighbouring pixels within
/// `reach` px of a point, by the contrast there, averaged over the points: about 0.5 … 1 for sharp
/// photographs, 1/w where edges are w px wide. Of the changes across and down the lesser counts,
/// because a camera that moves blurs in one direction.
[[nodiscard]] double sharpness(ImageView<const std::uint8_t> grey,
                               std::span<const std::array<double, 2>> points, int reach);

}  // namespace episcope::capture
