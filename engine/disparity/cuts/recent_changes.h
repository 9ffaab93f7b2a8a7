// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

#include <vector>

namespace episcope {

/// Where an expansion can be worth its time. Where nothing nearby has changed since a label was
/// last expanded, expanding it again would change nothing either, or so little that it is left out.
/// Kept for tiles of pixels, the views on top of each other.
class RecentChanges {
 public:
  /// Nothing is expanded yet.
  RecentChanges(int height, int width, int labels);

  /// For every tile: whether it or one beside it has changed since `label` was last expanded.
  [[nodiscard]] Image<char> since(int label) const;
  [[nodiscard]] static int tile_of(int pixel) { return pixel / kTile; }

  /// `label` is being expanded; what other labels change from here on is new to it.
  void begin(int label) { expanded_[label] = ++time_; }
  void mark(int y, int x) { changed_.at(tile_of(y), tile_of(x)) = time_; }

 private:
  // Larger than parallax between two views usually is.
  static constexpr int kTile = 24;

  int time_ = 0;
  Image<int> changed_;
  std::vector<int> expanded_;
};

}  // namespace episcope
