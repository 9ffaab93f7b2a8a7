// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/solvers/simplex/pair_duals.h"

#include <vector>

namespace episcope {

/// Distance between the rows of layers for images of this width.
[[nodiscard]] inline long layer_pitch(int width) {
  return (width / kLayerRowUnit + 1) * static_cast<long>(kLayerRowUnit);
}

/// The crystalline total variation whose unit ball is an octagon, written as weights of pairs of
/// pixels: of the four pixels of each cell (x, y)…(x + 1, y + 1),
/// (√2 − 1)·(|u_right − u| + |u_down − u|) + (1 − 1/√2)·(|u_across − u| + |u_right − u_down|),
/// times weight·g(x, y); at the image's border, where diagonals are missing, the sides count their
/// share too. A straight boundary costs its Euclidean length if it runs along the axes or
/// diagonals, and at most 8 % more in between.
///
/// The weights `[y][pair][x]` are also the largest size of the pairs' duals; 0 where a pair would
/// leave the image.
class PairLimits {
 public:
  /// `g` is `[y][x]` ≥ 0, one channel; empty = 1 everywhere.
  PairLimits(int height, int width, double weight, ImageView<const float> g);

  [[nodiscard]] const float* row(int y, int pair) const {
    return memory_.data() + begin_of(y, pair);
  }

 private:
  [[nodiscard]] long begin_of(int y, int pair) const {
    return kLayerRowUnit + (static_cast<long>(y) * kPairKinds + pair) * pitch_;
  }

  long pitch_;
  std::vector<float> memory_;
};

}  // namespace episcope
