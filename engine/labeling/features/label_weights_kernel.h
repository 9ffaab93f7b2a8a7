// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/isa.h"

namespace episcope {

/// The surfaces of all labels as a row of a view meets them (label_surfaces.h): arrays of `pitch`
/// floats, one a label, with dx = x − `middle`.
struct SurfaceRow {
  int width = 0;
  int pitch = 0;  ///< Labels, rounded up to whole vectors of the widest kind.
  const float* disparity = nullptr;
  const float* doubt = nullptr;     ///< Variance of each disparity, added to that of the surface.
  const float* is_known = nullptr;  ///< 0 = the misfit is that of half of the most;
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
  /// makes those of a pixel sum to 1 unless all are 0.
  void (*weigh)(const WeighedRow&, float* probabilities);
};

EPISCOPE_DECLARE_KERNEL(extern const LabelWeightsKernel kLabelWeightsKernel);

}  // namespace episcope
