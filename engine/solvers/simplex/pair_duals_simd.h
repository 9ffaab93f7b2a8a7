// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What the kernels of problems on layers share. For kernel sources only, as
/// engine/core/parallel/simd.h.

#include "engine/core/parallel/simd.h"
#include "engine/solvers/simplex/pair_duals.h"

namespace episcope::EPISCOPE_KERNEL_NAMESPACE {
namespace {

constexpr int kColumns = kLayerColumns;

struct AllLayers {
  static constexpr int kCount = 512;
  std::uint16_t layers[kCount] = {};
  constexpr AllLayers() {
    for (int l = 0; l < kCount; ++l) layers[l] = static_cast<std::uint16_t>(l);
  }
};
constexpr AllLayers kAllLayers;

[[maybe_unused]] inline LayerList all_layers(const LayeredShape& shape) {
  return {kAllLayers.layers, shape.steps};
}

// The layers of the block that begins at column `begin`.
[[maybe_unused]] inline LayerBlock block_of(const LayeredShape& shape, const PairDuals& row,
                                            int begin) {
  if (row.blocks != nullptr) return row.blocks[begin / kColumns];
  return {all_layers(shape), all_layers(shape), {}};
}

// The first `count` floats, then zeros.
[[maybe_unused]] inline Vec load_first(const float* from, int count) {
  if (count >= kLanes) return load(from);
  Vec value{};
  for (int i = 0; i < count; ++i) value[i] = from[i];
  return value;
}

[[maybe_unused]] inline Vec clamp(Vec value, Vec limit) {
  return greatest(least(value, limit), -limit);
}

[[maybe_unused]] inline int end_of(const LayeredShape& shape, int begin) {
  const int end = whole_registers(shape.width);
  return end < begin + kColumns ? end : begin + kColumns;
}

// What leaves a pixel through the pairs that begin at it, less what enters through those that end.
[[maybe_unused]] inline Vec divergence(const PairDuals& here, const PairDuals& above, long i) {
  return load(here.pair[0] + i) - load(here.pair[0] + i - 1) +     //
         (load(here.pair[1] + i) - load(above.pair[1] + i)) +      //
         (load(here.pair[2] + i) - load(above.pair[2] + i - 1)) +  //
         (load(here.pair[3] + i - 1) - load(above.pair[3] + i));
}

[[maybe_unused]] inline Vec limited(const PairDuals& row, int pair, long i, int x) {
  return clamp(load(row.pair[pair] + i), load(row.limit[pair] + x));
}

[[maybe_unused]] inline Vec limited_divergence(const PairDuals& here, const PairDuals& above,
                                               long i, int x) {
  return limited(here, 0, i, x) - limited(here, 0, i - 1, x - 1) +
         (limited(here, 1, i, x) - limited(above, 1, i, x)) +
         (limited(here, 2, i, x) - limited(above, 2, i - 1, x - 1)) +
         (limited(here, 3, i - 1, x - 1) - limited(above, 3, i, x));
}

[[maybe_unused]] void move_dual(const LayeredShape& shape, const float* ahead,
                                const float* ahead_below, const PairDuals& here) {
  const Vec step = splat(shape.dual_step), relaxation = splat(shape.relaxation);
  const auto move = [&](int pair, long i, int x, Vec difference) {
    float* const at = here.pair[pair] + i;
    const Vec old = load(at);
    const Vec next = clamp(old + step * difference, load(here.limit[pair] + x));
    store(at, old + relaxation * (next - old));
  };
  for (int begin = 0; begin < shape.width; begin += kColumns) {
    const int end = end_of(shape, begin);
    const LayerList paired = block_of(shape, here, begin).paired;
    for (int k = 0; k < paired.count; ++k) {
      for (int x = begin; x < end; x += kLanes) {
        const long i = paired.layers[k] * shape.pitch + x;
        const Vec at = load(ahead + i), right = load(ahead + i + 1);
        const Vec down = load(ahead_below + i), across = load(ahead_below + i + 1);
        move(0, i, x, right - at);
        move(1, i, x, down - at);
        move(2, i, x, across - at);
        move(3, i, x, down - right);
      }
    }
  }
}

}  // namespace
}  // namespace episcope::EPISCOPE_KERNEL_NAMESPACE
