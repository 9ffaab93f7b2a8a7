// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/isa.h"

namespace episcope {

/// Lanes that the kernels may read or write beyond the columns they are asked for.
inline constexpr int kSideSlack = 16;
/// Pixels to each side, in x and y, that vote with a pixel.
inline constexpr int kVoteRadius = 2;
inline constexpr int kVoteRows = 2 * kVoteRadius + 1;
inline constexpr int kNeighbours = 12;

/// What lies around the pixels of one row: in the k-th neighbour, disparity[k][x] of confidence
/// confidence[k][x].
struct NeighbourRow {
  const float* disparity[kNeighbours] = {};
  const float* confidence[kNeighbours] = {};
  const float* own_disparity = nullptr;
  const float* own_confidence = nullptr;
  int width = 0;
  float far_trust = 0;  ///< The share of the own confidence that a neighbour on the far side needs.
  /// Written: the least and the largest disparity, the own one included, and the confidences that
  /// belong to them.
  float* far = nullptr;
  float* near = nullptr;
  float* far_confidence = nullptr;
  float* near_confidence = nullptr;
};

/// One row to decide. Of the rows from y − 2 to y + 2, in columns from −2 to width + 2: residuals
/// of own, far and near disparities, and the colour of the view, far outside [0, 1] where there is
/// no pixel.
struct SideRow {
  const float* residual[3][kVoteRows] = {};
  const float* color[3][kVoteRows] = {};
  int width = 0;
  float sharpness = 1;  ///< 1/(8σ²): σ is the difference of colour of pixels that belong together.
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
  void (*gather)(const NeighbourRow&);
  void (*choose)(const SideRow&);
};

EPISCOPE_DECLARE_KERNEL(extern const SideKernel kSideKernel);

}  // namespace episcope
