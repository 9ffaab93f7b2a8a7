// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/isa.h"

namespace episcope {

/// Colours, as planes with a margin on all sides, and what their neighbours count.
struct SurfaceTaps {
  const float* channels[3] = {};    ///< The first pixel of the row at hand in each plane.
  const long* offsets = nullptr;    ///< From a pixel to each neighbour in its plane,
  const float* nearness = nullptr;  ///< log2 of what each counts for its distance,
  int count = 0;                    ///< and how many there are.
  float contrast = 0;  ///< log2 of what a neighbour counts is less by this times |ΔI|².
  int width = 0;       ///< Planes are readable 16 floats beyond it and the margin.
};

/// The kernel's entry point, one for each instruction set.
struct SurfaceKernel {
  /// The weighted means of a row, into rows that are writable 16 floats beyond the width.
  void (*filter)(const SurfaceTaps&, float* const* out);
};

EPISCOPE_DECLARE_KERNEL(extern const SurfaceKernel kSurfaceKernel);

}  // namespace episcope
