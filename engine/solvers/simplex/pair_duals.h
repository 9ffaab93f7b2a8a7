// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

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

/// Columns walked through all layers before the next ones: what is kept of each fits the first
/// cache, and a run within a layer is long enough for the prefetcher.
inline constexpr int kLayerColumns = 128;

/// Of a problem on layers without order.
inline constexpr int kMaxSimplexLayers = 256;

/// Numbers of layers, ascending.
struct LayerList {
  const std::uint16_t* layers = nullptr;
  int count = 0;
};

/// The layers of `kLayerColumns` columns of a row that take part. On others φ stays 0.
struct LayerBlock {
  LayerList moving;  ///< φ moves on these;
  LayerList paired;  ///< so do duals: pairs begin here that have one of `moving` at either end;
  LayerList still;   ///< φ does not move here but next to the block.
};

/// Duals of the pairs of one row, and the largest size each may have (the same on every layer).
struct PairDuals {
  float* pair[kPairKinds] = {};
  const float* limit[kPairKinds] = {};
  const LayerBlock* blocks = nullptr;  ///< Of this row; null = all layers take part.
};

}  // namespace episcope
