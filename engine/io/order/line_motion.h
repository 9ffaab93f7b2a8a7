// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

#include <string>

namespace episcope::io {

/// How points move between views of a line: medians over squares of 16 px with texture in both
/// directions, in px of pictures of at most 512 px.
struct LineMotion {
  double along = 0;
  double across = 0;
  int step = 0;     ///< Between views so many apart;
  int squares = 0;  ///< of so many squares.

  /// Whether points move across the line as well, as in a film of a camera that zooms or turns:
  /// by more than a quarter of a pixel, and by three tenths of how they move along it.
  [[nodiscard]] bool is_askew() const;
  /// A sentence about that.
  [[nodiscard]] std::string warning() const;
};

/// Looks at the view in the middle of a single row or column and one beside it, farther ones where
/// those next to it hardly move. Precondition: the grid is a line. Throws Cancelled.
[[nodiscard]] LineMotion measure_line_motion(const LightField::Samples& samples,
                                             const Progress& progress);

}  // namespace episcope::io
