// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/array/volume.h"
#include "engine/core/parallel/progress.h"
#include "engine/solvers/simplex/pair_duals.h"

#include <bitset>
#include <cstdint>
#include <vector>

namespace episcope {

/// Which layers take part where in a problem on layers without order, as long as it need not be
/// solved exactly: where a layer is far from the cheapest at every pixel around, it hardly ever
/// wins, and neither φ nor the duals of its pairs move from 0.
class RacingLayers {
 public:
  /// Decided for tiles of `kLayerColumns` by so many pixels.
  static constexpr int kTileRows = 8;

  /// For images of this size, at most kMaxSimplexLayers layers; all of them take part.
  RacingLayers(int height, int layers, int width);

  void take_all() { takes_all_ = true; }
  /// Those that cost less than `behind` more than the cheapest one somewhere in the tile or in
  /// those above and below it, and those of `labels` (`[y][x]`, a layer each) there.
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
  // In any of the tiles from these to those, as far as there are any.
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

}  // namespace episcope
