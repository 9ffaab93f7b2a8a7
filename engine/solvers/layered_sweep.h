// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/memory.h"
#include "engine/core/progress.h"
#include "engine/solvers/layered_kernel.h"

#include <algorithm>
#include <bitset>
#include <cstdint>
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

/// The layers that take part at each place, in a problem on layers without order that need not be
/// solved exactly yet. A layer that is far from the cheapest at every pixel around hardly ever
/// wins: φ and the duals of its pairs stay 0.
class RacingLayers {
 public:
  /// Decided for tiles of `kLayerColumns` by so many pixels.
  static constexpr int kTileRows = 8;

  /// For images of this size, at most kMaxSimplexLayers layers; all of them take part.
  RacingLayers(int height, int layers, int width);

  void take_all() { takes_all_ = true; }
  /// Those that cost less than `behind` more than the cheapest one somewhere in the tile or in
  /// those above and below it, and the layers that `labels` (`[y][x]`) has there.
  void choose(VolumeView<const float> cost, float behind, ImageView<const int> labels,
              const Progress& progress);

  /// The blocks of row y, for PairDuals; null = all layers take part.
  [[nodiscard]] const LayerBlock* row(int y) const {
    return takes_all_ ? nullptr : blocks_.data() + static_cast<std::ptrdiff_t>(y) * across_;
  }

 private:
  using Layers = std::bitset<kMaxSimplexLayers>;
  struct Lists {
    std::vector<std::uint16_t> moving, paired, still;
  };

  [[nodiscard]] Layers& at(std::vector<Layers>& tiles, int row, int column) const {
    return tiles[static_cast<std::size_t>(row) * across_ + column];
  }
  // In any tile from the first to the last one, within the image.
  [[nodiscard]] Layers in_any(const std::vector<Layers>& tiles, int first_row, int first_column,
                              int last_row, int last_column) const;
  void find_near(VolumeView<const float> cost, float behind, ImageView<const int> labels, int row);
  void list(int row, int column);

  int height_, layers_, width_;
  int across_, down_;  // tiles
  bool takes_all_ = true;
  std::vector<Layers> near_, moving_;  // of each tile
  std::vector<Lists> lists_;
  std::vector<LayerBlock> blocks_;  // [y][tile]
};

/// Moves of one row, in the form that the kernels of the solvers have them.
struct LayeredMoves {
  /// One row of φ: a step along the divergence and down the costs, projected to what is allowed;
  /// `ahead` = 2·projected − old. `cost` is `[layer][x]`, `width` apart.
  void (*primal)(const LayeredShape&, const float* cost, const PairDuals& here,
                 const PairDuals& above, float* phi, float* ahead);
  /// One row of the duals: a step along the gradient of `ahead`, projected to the limits.
  void (*dual)(const LayeredShape&, const float* ahead, const float* ahead_below,
               const PairDuals& here);
};

/// The unknowns of a primal-dual method on an image with layers (φ and the duals of its pairs) and
/// the order of their updates. Bands of rows are updated in parallel and in place; within a band, φ
/// of a row and the duals of the row above alternate, so that an iteration traverses memory once.
/// Few threads take several iterations through the image at once, each two rows behind the one
/// before, so that all of them traverse memory once. The result is the same. 5 floats per pixel and
/// layer.
class LayeredSweep {
 public:
  /// Rows that one thread takes through an iteration on its own.
  static constexpr int kBandRows = 32;
  struct Band {
    int begin = 0, end = 0;
  };

  /// Room for images of this size. What is there is not initialized: call `clear` on every band.
  LayeredSweep(int height, int layers, int width);

  /// φ and duals of a band become 0.
  void clear(const Band& band);
  /// φ becomes 0 on layers that do not move, and the duals on those that are not paired.
  void clear_all_but(const RacingLayers& racing, const Band& band);
  /// Input of an iteration; borrowed. It may change between calls, and so may the steps.
  struct Terms {
    VolumeView<const float> cost;
    const PairLimits& limits;
    const LayeredMoves& moves;
    const RacingLayers* racing = nullptr;  // null = all layers take part
  };
  /// Several iterations. Throws Cancelled.
  void iterate(const Terms& terms, int count, const Progress& progress);

  [[nodiscard]] LayeredShape& shape() { return shape_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int bands() const { return (height_ + kBandRows - 1) / kBandRows; }
  [[nodiscard]] Band band(int i) const;
  /// Row y of φ, `[layer][x]`, and of the duals; above the first row there are no pairs.
  [[nodiscard]] float* phi(int y) { return phi_.get() + kLayerRowUnit + y * row_size(); }
  [[nodiscard]] PairDuals duals(int y);  // without limits
  [[nodiscard]] PairDuals duals_above(int y);
  [[nodiscard]] PairDuals duals(int y, const PairLimits& limits);
  [[nodiscard]] PairDuals duals_above(int y, const PairLimits& limits);
  [[nodiscard]] long row_size() const { return shape_.steps * shape_.pitch; }

 private:
  void iterate_bands(const Terms& terms, const Progress& progress);
  struct Part;
  // Moves row y of φ and the duals of the row above it.
  void move_primal(const Terms& terms, int y, float* ahead);
  void move_dual(const Terms& terms, int y, const float* ahead, const float* ahead_below);
  void iterate_part(const Terms& terms, const Part& part, const Progress& progress);
  // Row y of 2φ' − φ of a band: its first and last row are kept for the neighboring bands.
  [[nodiscard]] float* ahead(int y, float* scratch);
  // Kernels read a lane beyond a row: it must not be where another thread writes.
  [[nodiscard]] long edges_size() const { return 2 * row_size() + kLayerRowUnit; }

  LayeredShape shape_;
  int height_;
  LargeArray<float> phi_;
  LargeArray<float> duals_;  // [y][pair][layer][x]
  std::vector<float> edges_;
  std::vector<float> nothing_;
};

/// Means of blocks of 2×2 pixels (fewer at the right and lower border), `[y][layer][x]`. `to` has
/// half the size of `from`, rounded up.
void halve(VolumeView<const float> from, const Progress& progress, VolumeView<float> to);
[[nodiscard]] Image<float> halved(ImageView<const float> from);

/// Initializes `fine` with the result of `coarse`, of half the size: φ is repeated, duals are
/// distributed over the two pairs of pixels that replace one, and interpolated in between. Costs of
/// both are per pixel, so duals and smoothness of the finer level are twice as large.
void begin_from(LayeredSweep& coarse, const Progress& progress, LayeredSweep& fine);

/// Initializes `to` with the result of `from`, of the same size, for an image whose pixels have
/// moved. Each pixel takes φ and the duals of the pixel y'·width + x' given in `places` `[y][x]`;
/// −1 stands for its own place. On layers that do not take part both are 0.
void begin_from_moved(LayeredSweep& from, ImageView<const std::int32_t> places,
                      const RacingLayers& racing, const Progress& progress, LayeredSweep& to);

}  // namespace episcope
