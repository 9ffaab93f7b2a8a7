// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/simplex/pair_limits.h"

#include <cmath>

namespace episcope {
namespace {

const float kSide = std::sqrt(2.0F) - 1;
const float kDiagonal = 1 - std::sqrt(0.5F);

}  // namespace

PairLimits::PairLimits(int height, int width, double weight, ImageView<const float> g)
    : pitch_(layer_pitch(width)),
      memory_(static_cast<std::size_t>(height) * kPairKinds * pitch_ + 2 * kLayerRowUnit) {
  for (int y = 0; y < height; ++y) {
    const bool down = y + 1 < height;
    // The share of diagonals missing above the first row and below the last one.
    const float along = kSide + kDiagonal * static_cast<float>((y == 0 ? 1 : 0) + (down ? 0 : 1));
    for (int x = 0; x < width; ++x) {
      const bool right = x + 1 < width;
      const float aside =
          kSide + kDiagonal * static_cast<float>((x == 0 ? 1 : 0) + (right ? 0 : 1));
      const float here = static_cast<float>(weight) * (g.empty() ? 1.0F : g.at(y, x));
      const float diagonal = right && down ? here * kDiagonal : 0;
      memory_[begin_of(y, 0) + x] = right ? here * along : 0;
      memory_[begin_of(y, 1) + x] = down ? here * aside : 0;
      memory_[begin_of(y, 2) + x] = diagonal;
      memory_[begin_of(y, 3) + x] = diagonal;
    }
  }
}

}  // namespace episcope
