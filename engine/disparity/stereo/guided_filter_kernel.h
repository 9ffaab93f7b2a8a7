// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/isa.h"

namespace episcope {

/// Lanes that the guided filter's kernel may read or write beyond the columns of a row.
inline constexpr int kGuidedSlack = 16;
/// Planes of sums: the values alone, and times each channel of the guide.
inline constexpr int kGuidedPlanes = 4;
inline constexpr int kMaxGuidedRadius = 8;

/// One row of what the filter knows of the guide.
struct GuideRow {
  int channels = 0;
  int width = 0;
  int radius = 0;
  const float* guide[3] = {};
  const float* mean[3] = {};     ///< Over the window.
  const float* inverse[6] = {};  ///< Of covariance + regularisation: 00, 01, 02, 11, 12, 22.
  const float* share = nullptr;  ///< 1 / columns of the window that lie within the image.
};

/// Sums along x over the window's columns, of up to 2·radius + 1 rows of it.
struct GuidedSums {
  int rows = 0;
  const float* planes[2 * kMaxGuidedRadius + 1][kGuidedPlanes] = {};
};

/// The three steps of the guided filter, each for one row. `scratch` has width + 2·radius + slack
/// lanes.
struct GuidedKernel {
  /// Sums along x of values and of values · guide.
  void (*sum_products)(const GuideRow&, const float* values, float* scratch, float* const* out);
  /// Solves for the local affine model, a and b with a·guide + b ≈ values in the window, and sums
  /// it along x: b, then a of each channel. `models` has a row of scratch for each plane.
  void (*solve)(const GuideRow&, const GuidedSums&, float* scratch, float* const* models,
                float* const* out);
  /// The mean model applied to the guide.
  void (*apply)(const GuideRow&, const GuidedSums&, float* out);
};

EPISCOPE_DECLARE_KERNEL(extern const GuidedKernel kGuidedKernel);

}  // namespace episcope
