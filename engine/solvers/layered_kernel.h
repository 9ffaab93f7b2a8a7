// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/isa.h"
#include "engine/solvers/shared_constants.h"

#include <cstdint>

namespace episcope {

/// A row of unknowns, `[layer][x]`: `layers` rows of `width` numbers, `pitch` apart.
struct LinkedRow {
  int layers = 0;
  int width = 0;
  long pitch = 0;
};

/// Numbers kept in 16 bits as fixed-point fractions of `unit`.
struct Packed {
  const std::int16_t* data = nullptr;
  float unit = 1;
};

/// The dual step of a row of links.
struct LinkStep {
  float step = 1;
  float relaxation = 1;
  const float* limit = nullptr;  ///< The largest size of each link's duals, `[x]`.
};

/// The kernel's entry points, one set for each instruction set.
struct LinkedKernel {
  void (*unpack)(Packed from, long count, float* to);
  /// Rounds to the nearest fraction; what does not fit becomes the largest that does.
  void (*pack)(const float* from, long count, float unit, std::int16_t* to);
  /// Costs of a row: `table[code]`, `width` apart.
  void (*look_up)(const std::uint8_t* codes, const float* table, long count, float* cost);
  /// cost −= q of the links that begin in the row. Duals beyond the limits count as the limits.
  void (*leave)(const LinkedRow&, Packed q, const float* limit, float* cost);
  /// cost += q of the links that end in the row, each found at `q.data[from[x] + l·pitch]`.
  void (*arrive)(const LinkedRow&, Packed q, const long* from, const float* limit, float* cost);
  /// Moves the duals q of a row of links along the differences of `ahead` between their ends, the
  /// far one at `there.data[to[x] + l·pitch]`, and limits them. The unit of q is `q_unit`.
  void (*move)(const LinkedRow&, Packed here, Packed there, const long* to, const LinkStep&,
               float q_unit, std::int16_t* q);
};

EPISCOPE_DECLARE_KERNEL(extern const LinkedKernel kLinkedKernel);

/// Floats that a row is padded to, the widest vector.
inline constexpr long kLayerRowUnit = 16;

/// Shape of the rows of a problem on layers (levels, labels). `steps` is the number of
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

/// Most layers of a problem on layers without order.
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

inline constexpr int kMaxLiftedLayers = 512;

/// The kernel's entry points, one set for each instruction set.
struct LiftedKernel {
  /// One row of φ: a step along the divergence and down the costs, projected to 1 ≥ φ_1 ≥ … ≥ 0
  /// `ahead` = 2·projected − old. `cost` is `[layer][x]`, `width` apart.
  void (*move_primal)(const LayeredShape&, const float* cost, const PairDuals& here,
                      const PairDuals& above, float* phi, float* ahead);
  /// One row of the duals: a step along the gradient of `ahead`, projected to the limits.
  void (*move_dual)(const LayeredShape&, const float* ahead, const float* ahead_below,
                    const PairDuals& here);
  /// Σ_x min_k [ρ_k − Σ_{l ≤ k} div p_l] of one row, with the duals projected to the limits.
  double (*bound)(const LayeredShape&, const float* cost, const PairDuals& here,
                  const PairDuals& above);
  /// The labels of one row at each threshold.
  void (*cut)(const LayeredShape&, const float* phi, int* const labels[kLiftedCuts]);
};

EPISCOPE_DECLARE_KERNEL(extern const LiftedKernel kLiftedKernel);

/// The kernel's entry points, one set for each instruction set. Rows of u are `[layer][x]`, `pitch`
/// apart; of the costs `width` apart.
struct SimplexKernel {
  /// One row of u: a step along the divergence and down the costs, projected to u ≥ 0, Σ u = 1;
  /// `ahead` = 2·projected − old. Only on layers that the blocks of `here` name.
  void (*move_primal)(const LayeredShape&, const float* cost, const PairDuals& here,
                      const PairDuals& above, float* u, float* ahead);
  /// One row of the duals: a step along the gradient of `ahead`, projected to the limits;
  /// likewise.
  void (*move_dual)(const LayeredShape&, const float* ahead, const float* ahead_below,
                    const PairDuals& here);
  /// Projects the columns of a row to u ≥ 0, Σ u = 1.
  void (*project)(const LayeredShape&, const float* from, float* to);
  /// Σ_x min_l [c_l − div p_l] of one row, with the duals projected to the limits.
  double (*bound)(const LayeredShape&, const float* cost, const PairDuals& here,
                  const PairDuals& above);
  /// Σ_x <c, u> + Σ limit·|difference of u| over the pairs of one row.
  double (*energy)(const LayeredShape&, const float* cost, const PairDuals& here, const float* u,
                   const float* u_below);
  /// The layer of the largest u of each pixel of one row; of equals the lowest.
  void (*cut)(const LayeredShape&, const float* u, int* labels);
};

EPISCOPE_DECLARE_KERNEL(extern const SimplexKernel kSimplexKernel);

}  // namespace episcope
