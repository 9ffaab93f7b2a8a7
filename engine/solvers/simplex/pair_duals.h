// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// Floats that a row is padded to, the widest vector.
inline constexpr long kLayerRowUnit = 16;
/// Pairs of neighbours of a pixel's cell: right, down, down-right, and its right with its lower
/// neighbour.
inline constexpr int kPairKinds = 4;

/// What the rows of a problem on layers (levels, labels) have in common. `steps` is the number of
/// layers of the unknown φ; rows of φ, of its duals and of `ahead` are `[step][x]`, `pitch` apart,
/// pitch > width, readable for 16 floats before the first. Beyond the width duals are 0.
struct LayeredShape {
  int steps = 0;
  int width = 0;
  long pitch = 0;
  float primal_step = 0, dual_step = 0;
  float relaxation = 1;
};

/// Duals of the pairs of one row, and the largest size each may have (the same on every layer).
struct PairDuals {
  float* pair[kPairKinds] = {};
  const float* limit[kPairKinds] = {};
};

}  // namespace episcope
