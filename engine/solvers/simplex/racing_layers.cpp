// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/simplex/racing_layers.h"

#include "engine/core/parallel/parallel.h"
#include "engine/solvers/simplex/pair_labels.h"

#include <algorithm>

namespace episcope {
namespace {

bool is_any_near(const float* cost, const float* least, int count, float behind) {
  int near = 0;
  for (int x = 0; x < count; ++x) near |= cost[x] - least[x] < behind ? 1 : 0;
  return near != 0;
}

LayerList as_list(const std::vector<std::uint16_t>& layers) {
  return {layers.data(), static_cast<int>(layers.size())};
}

}  // namespace

RacingLayers::RacingLayers(int height, int layers, int width)
    : height_(height),
      layers_(layers),
      width_(width),
      across_((width + kLayerColumns - 1) / kLayerColumns),
      down_((height + kTileRows - 1) / kTileRows) {}

void RacingLayers::choose(VolumeView<const float> cost, float behind, ImageView<const int> labels,
                          const Progress& progress) {
  const std::size_t tiles = static_cast<std::size_t>(across_) * down_;
  near_.assign(tiles, {});
  moving_.resize(tiles);
  lists_.resize(tiles);
  blocks_.resize(static_cast<std::size_t>(height_) * across_);
  parallel_for(down_, progress, [&](int row) { find_near(cost, behind, labels, row); });
  for (int row = 0; row < down_; ++row) {
    for (int column = 0; column < across_; ++column) {
      at(moving_, row, column) = in_any(near_, row - 1, column, row + 1, column);
    }
  }
  parallel_for(down_, progress, [&](int row) {
    for (int column = 0; column < across_; ++column) list(row, column);
  });
  takes_all_ = false;
}

void RacingLayers::find_near(VolumeView<const float> cost, float behind,
                             ImageView<const int> labels, int row) {
  std::vector<float> least;
  std::vector<int> cheapest(static_cast<std::size_t>(width_));
  for (int y = row * kTileRows; y < std::min(height_, (row + 1) * kTileRows); ++y) {
    take_cheapest(cost, y, cheapest.data(), least);
    for (int column = 0; column < across_; ++column) {
      Layers& near = at(near_, row, column);
      const int begin = column * kLayerColumns, end = std::min(width_, begin + kLayerColumns);
      for (int l = 0; l < layers_; ++l) {
        if (near[l]) continue;
        near[l] = is_any_near(cost.row(y, l) + begin, least.data() + begin, end - begin, behind);
      }
      for (int x = begin; x < end; ++x) near.set(labels.at(y, x));
    }
  }
}

RacingLayers::Layers RacingLayers::in_any(const std::vector<Layers>& tiles, int first_row,
                                          int first_column, int last_row, int last_column) const {
  Layers all;
  for (int row = std::max(first_row, 0); row <= std::min(last_row, down_ - 1); ++row) {
    for (int u = std::max(first_column, 0); u <= std::min(last_column, across_ - 1); ++u) {
      all |= tiles[static_cast<std::size_t>(row) * across_ + u];
    }
  }
  return all;
}

void RacingLayers::list(int row, int column) {
  Lists& lists = lists_[static_cast<std::size_t>(row) * across_ + column];
  const auto fill = [&](const Layers& from, std::vector<std::uint16_t>& to) {
    to.clear();
    for (int l = 0; l < layers_; ++l) {
      if (from[l]) to.push_back(static_cast<std::uint16_t>(l));
    }
  };
  const Layers& moving = at(moving_, row, column);
  fill(moving, lists.moving);
  fill(in_any(moving_, row, column, row + 1, column + 1), lists.paired);
  fill(in_any(moving_, row - 1, column - 1, row + 1, column + 1) & ~moving, lists.still);
  for (int y = row * kTileRows; y < std::min(height_, (row + 1) * kTileRows); ++y) {
    blocks_[static_cast<std::size_t>(y) * across_ + column] = {
        as_list(lists.moving), as_list(lists.paired), as_list(lists.still)};
  }
}

}  // namespace episcope
