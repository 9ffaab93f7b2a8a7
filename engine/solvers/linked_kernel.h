// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/isa.h"

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

}  // namespace episcope
