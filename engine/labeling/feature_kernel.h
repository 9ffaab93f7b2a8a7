// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/isa.h"

namespace episcope {

/// The surfaces of all labels as a row of a view meets them (LabelSurfaces): arrays of `pitch`
/// floats, one a label, with dx = x − `middle`.
struct SurfaceRow {
  int width = 0;
  int pitch = 0;  ///< Labels, rounded up to whole vectors of the widest kind.
  const float* disparity = nullptr;
  const float* is_known = nullptr;  ///< 0 = the misfit is half of `most`;
  const float* middle = nullptr;    ///< otherwise the surface is at
  const float* at = nullptr;        ///< at + across·dx,
  const float* across = nullptr;    ///< and its variance is
  const float* variance = nullptr;  ///< variance · (1 + flat + slope·dx + bend·dx²).
  const float* flat = nullptr;
  const float* slope = nullptr;
  const float* bend = nullptr;
  float noise = 0;  ///< Variance below which disparities say nothing.
  float most = 0;   ///< Largest misfit.
};

/// A row of probabilities `[x][label]`, and how they are weighed.
struct WeighedRow {
  int width = 0;
  int pitch = 0;
  const float* against = nullptr;     ///< `[x][label]`: what speaks against each label.
  const float* strength = nullptr;    ///< Of each pixel, ≥ 0.
  const float* is_weighed = nullptr;  ///< `[label]`: 1, or 0 where the weight is 1.
  const float* floor = nullptr;       ///< `[label]`: added to each probability before.
  float most = 0;                     ///< At most so much speaks against a label.
};

/// The kernel's entry points, one set for each instruction set.
struct LabelWeightsKernel {
  /// ½ log((v + r²)² / (v·noise)), v the variance and r the distance from the surface,
  /// `[x][label]`.
  void (*misfits)(const SurfaceRow&, float* out);
  /// Multiplies each by exp(−strength · what speaks against it more than against the best one), and
  /// normalizes the sum of each pixel to 1 unless all are 0.
  void (*weigh)(const WeighedRow&, float* probabilities);
};

EPISCOPE_DECLARE_KERNEL(extern const LabelWeightsKernel kLabelWeightsKernel);

/// A grid of pixels that each hold one distance for every label.
struct DistanceGrid {
  int height = 0;
  int width = 0;
  int pitch = 0;               ///< Labels, rounded up to whole vectors of the widest kind.
  float* distances = nullptr;  ///< `[y][x][label]`, `pitch` apart.
  /// Lengths of the ways from a pixel to its neighbors right, down, down-right and down-left,
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

/// Colors, as planes with a margin on all sides, and what their neighbors count.
struct SurfaceTaps {
  const float* channels[3] = {};    ///< The first pixel of the row at hand in each plane.
  const long* offsets = nullptr;    ///< From a pixel to each neighbor in its plane,
  const float* nearness = nullptr;  ///< log2 of what each counts for its distance,
  int count = 0;                    ///< and how many there are.
  float contrast = 0;  ///< log2 of what a neighbor counts is less by this times |ΔI|².
  int width = 0;       ///< Planes are readable 16 floats beyond it and the margin.
};

/// The kernel's entry point, one for each instruction set.
struct SurfaceKernel {
  /// The weighted means of a row, into rows that are writable 16 floats beyond the width.
  void (*filter)(const SurfaceTaps&, float* const* out);
};

EPISCOPE_DECLARE_KERNEL(extern const SurfaceKernel kSurfaceKernel);

}  // namespace episcope
