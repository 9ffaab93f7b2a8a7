// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/isa.h"
#include "engine/disparity/kernels/shared_constants.h"

#include <cstdint>

namespace episcope {

/// Lanes that the kernel may read or write beyond the columns it is asked for.
inline constexpr int kResidualSlack = 16;

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

/// Elements before and after each row below that may be read, and after it written.
inline constexpr int kTrustSlack = 16;

/// Three rows of packed samples (PackedViews): where a neighbor does not exist, the one opposite
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

/// Lanes that the kernels may read or write beyond the columns they are asked for.
inline constexpr int kSideSlack = 16;
inline constexpr int kVoteRows = 2 * kVoteRadius + 1;

/// What lies around the pixels of one row: in the k-th neighbor, disparity[k][x] of confidence
/// confidence[k][x].
struct NeighborRow {
  const float* disparity[kSideNeighbors] = {};
  const float* confidence[kSideNeighbors] = {};
  const float* own_disparity = nullptr;
  const float* own_confidence = nullptr;
  int width = 0;
  float far_trust = 0;  ///< The share of the own confidence that a neighbor on the far side needs.
  /// Written: the least and the largest disparity, the own one included, and the confidences that
  /// belong to them.
  float* far = nullptr;
  float* near = nullptr;
  float* far_confidence = nullptr;
  float* near_confidence = nullptr;
};

/// One row to decide. Of the rows from y − 2 to y + 2, in columns from −2 to width + 2: residuals
/// of own, far and near disparities, and the color of the view, far outside [0, 1] where there is
/// no pixel.
struct SideRow {
  const float* residual[3][kVoteRows] = {};
  const float* color[3][kVoteRows] = {};
  int width = 0;
  float sharpness = 1;  ///< 1/(8σ²): σ is the difference of color of pixels that belong together.
  float least_step = 0;  ///< A side that is less far off is no other.
  /// The share of the own residual that the other's must be below.
  float far_advantage = 1, near_advantage = 1;
  /// A ray that keeps its disparity, nearer than the far side by more than `doubtful_step`, keeps
  /// doubtful_share + relief·(far/own − 1) of its confidence, at most all; far and own are the
  /// residuals.
  float doubtful_step = 0, doubtful_share = 1, relief = 0;
  const float* far = nullptr;
  const float* near = nullptr;
  const float* far_confidence = nullptr;
  const float* near_confidence = nullptr;
  /// Read and written.
  float* disparity = nullptr;
  float* confidence = nullptr;
};

struct SideKernel {
  void (*gather)(const NeighborRow&);
  void (*choose)(const SideRow&);
};

EPISCOPE_DECLARE_KERNEL(extern const SideKernel kSideKernel);

}  // namespace episcope
