// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/cuts/recent_changes.h"

#include <algorithm>

namespace episcope {

RecentChanges::RecentChanges(int height, int width, int labels)
    : changed_(tile_of(height - 1) + 1, tile_of(width - 1) + 1), expanded_(labels, -1) {}

Image<char> RecentChanges::since(int label) const {
  Image<char> result(changed_.height(), changed_.width());
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x) {
      if (changed_.at(y, x) <= expanded_[label]) continue;
      for (int i = std::max(0, y - 1); i < std::min(result.height(), y + 2); ++i) {
        for (int j = std::max(0, x - 1); j < std::min(result.width(), x + 2); ++j) {
          result.at(i, j) = 1;
        }
      }
    }
  }
  return result;
}

}  // namespace episcope
