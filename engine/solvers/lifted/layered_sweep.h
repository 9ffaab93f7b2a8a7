// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/large_memory.h"
#include "engine/core/array/volume.h"
#include "engine/core/parallel/progress.h"
#include "engine/solvers/simplex/pair_duals.h"
#include "engine/solvers/simplex/pair_limits.h"
#include "engine/solvers/simplex/racing_layers.h"

#include <functional>
#include <vector>

namespace episcope {

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

/// The unknowns of a primal-dual method on an image with layers, φ and the duals of its pairs, and
/// the order in which they are updated: bands of rows in parallel, within a band φ of a row and the
/// duals of the row above in turn, so that memory is traversed once per iteration and everything is
/// updated in place. Few threads take several iterations through the image at once, each two rows
/// behind the one before, so that memory is traversed once for all of them. The result is the same.
/// 5 floats per pixel and layer.
class LayeredSweep {
 public:
  /// Rows that one thread takes through an iteration on its own.
  static constexpr int kBandRows = 32;
  struct Band {
    int begin = 0, end = 0;
  };

  /// Room for images of this size. What is there is not initialised: call `clear` on every band.
  LayeredSweep(int height, int layers, int width);

  /// φ and duals of a band become 0.
  void clear(const Band& band);
  /// φ becomes 0 on layers that do not move, and the duals on those that are not paired.
  void clear_all_but(const RacingLayers& racing, const Band& band);
  /// What an iteration needs; borrowed. May change from one call to the next, as the steps may.
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
  // Row y of 2φ' − φ of a band: its first and last row are kept for the neighbouring bands.
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

}  // namespace episcope
