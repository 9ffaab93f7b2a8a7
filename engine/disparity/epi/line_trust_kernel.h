// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/isa.h"

#include <cstdint>

namespace episcope {

/// Elements before and after each row below that may be read, and after it written.
inline constexpr int kTrustSlack = 16;

/// Three rows of packed samples (PackedViews): where a neighbour does not exist, the one opposite
/// stands in its place, also before and after each row.
struct GradientRow {
  const std::uint32_t* above = nullptr;
  const std::uint32_t* here = nullptr;
  const std::uint32_t* below = nullptr;
  int width = 0;
  float* mean =
      nullptr;  ///< Σ over axes of the mean of both squared differences; samples in [0, 1].
  float* own = nullptr;  ///< Σ over axes of the smaller one.
};

/// What lowers the confidence of a row: see reduce_confidence.
struct TrustRow {
  const float* residual = nullptr;  ///< Infinite where nothing can be said.
  const float* own = nullptr;       ///< Squared gradients,
  const float* window = nullptr;    ///< and their mean around.
  int width = 0;
  float variance = 0;  ///< Of residuals, by noise.
  float noise = 0;     ///< s²
  float texture_gain = 1;
  float* trust = nullptr;  ///< t_line·t_texture to the power ¼.
};

struct TrustKernel {
  void (*gradients)(const GradientRow&);
  void (*trust)(const TrustRow&);
};

EPISCOPE_DECLARE_KERNEL(extern const TrustKernel kTrustKernel);

}  // namespace episcope
