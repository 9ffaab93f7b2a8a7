// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/isa.h"

#include <cstdint>

namespace episcope {

/// Lanes that the kernel may read or write beyond the columns it is asked for.
inline constexpr int kResidualSlack = 16;
inline constexpr int kMaxArmViews = 4;

/// Views to one side of another in its row or column of the camera grid, nearest first; the sample
/// of a pixel with disparity d stands at x + k·step·d in the k-th of them (k from 1), or, vertical,
/// at y + k·step·d.
struct LineArm {
  const std::uint32_t* views[kMaxArmViews] = {};
  int count = 0;
  int step = 1;
  bool vertical = false;
};

/// One row of a view, beside up to four arms. Samples are packed (PackedViews).
struct ResidualRow {
  const std::uint32_t* own = nullptr;  ///< The row's samples; slack behind.
  const float* disparity = nullptr;    ///< Likewise.
  float* residual = nullptr;           ///< Written; slack behind.
  LineArm arms[4] = {};
  int arm_count = 0;
  int min_views = 1;  ///< An arm with fewer views that see the line does not count.
  int y = 0, height = 0, width = 0;
  bool has_invalid = false;  ///< Whether samples may be marked as not valid: these do not count.
};

/// Least mean squared difference along an arm, samples in [0, 1], squares summed over channels;
/// infinite where no arm counts.
struct ResidualKernel {
  void (*row)(const ResidualRow&);
};

EPISCOPE_DECLARE_KERNEL(extern const ResidualKernel kResidualKernel);

}  // namespace episcope
