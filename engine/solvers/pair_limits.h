// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/solvers/layered_kernel.h"

#include <algorithm>
#include <string>
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

// What the solvers share that choose one layer, a label, for every pixel.

/// The cheapest layer of each pixel of row `y` into `labels`, of equals the lowest; its cost into
/// `least`. Both get a row's width.
void take_cheapest(VolumeView<const float> cost, int y, int* labels, std::vector<float>& least);

/// Throws InvalidInput unless `g`, if there is any, is one channel of height × width, and the
/// smoothness at least 0.
void check_boundaries(ImageView<const float> g, double smoothness, int height, int width);

/// (energy − bound)/|energy|; 0 if they are equal.
[[nodiscard]] double labeling_gap(double energy, double bound);

/// The text for a stage of a solver: "labeling, gap 1.0e-03".
[[nodiscard]] std::string labeling_gap_text(double gap);

/// Energy of the pairs that begin in row `y` of a labeling `u`, each its limit times
/// `jump(from, to)`.
template <class Jump>
[[nodiscard]] double boundary_row_energy(const PairLimits& limits, ImageView<const int> u, int y,
                                         const Jump& jump) {
  const int* const here = u.row(y);
  const int* const below = u.row(std::min(y + 1, u.height - 1));
  const auto pair = [&](int kind, int x, int from, int to) {
    return static_cast<double>(limits.row(y, kind)[x]) * jump(from, to);
  };
  double sum = 0;
  for (int x = 0; x < u.width; ++x) {
    const int right = std::min(x + 1, u.width - 1);
    sum += pair(0, x, here[x], here[right]) + pair(1, x, here[x], below[x]) +
           pair(2, x, here[x], below[right]) + pair(3, x, here[right], below[x]);
  }
  return sum;
}

/// Energy of row `y` of a labeling `u`: the costs of its pixels and of the pairs that begin there.
template <class Jump>
[[nodiscard]] double pair_row_energy(VolumeView<const float> cost, const PairLimits& limits,
                                     ImageView<const int> u, int y, const Jump& jump) {
  double sum = boundary_row_energy(limits, u, y, jump);
  for (int x = 0; x < cost.width; ++x) sum += static_cast<double>(cost.at(y, u.at(y, x), x));
  return sum;
}

/// Potts: a jump changes the layers of both labels, each weighted by half of λ.
[[nodiscard]] inline double potts_jump(int from, int to) {
  return from == to ? 0.0 : 2.0;
}

}  // namespace episcope
