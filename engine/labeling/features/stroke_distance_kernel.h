// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/isa.h"

namespace episcope {

/// A grid of pixels that each hold one distance for every label.
struct DistanceGrid {
  int height = 0;
  int width = 0;
  int pitch = 0;               ///< Labels, rounded up to whole vectors of the widest kind.
  float* distances = nullptr;  ///< `[y][x][label]`, `pitch` apart.
  /// Lengths of the ways from a pixel to its neighbours right, down, down-right and down-left,
  /// `[y][x]`; those that leave the image are infinite.
  const float* ways[4] = {};
};

/// The kernel's entry points, one set for each instruction set.
struct StrokeDistanceKernel {
  /// One row of the sweep to the right and down: distances by way of the row above and of the pixel
  /// to the left.
  void (*sweep_down)(const DistanceGrid&, int y);
  /// One row of the sweep back.
  void (*sweep_up)(const DistanceGrid&, int y);
};

EPISCOPE_DECLARE_KERNEL(extern const StrokeDistanceKernel kStrokeDistanceKernel);

}  // namespace episcope
