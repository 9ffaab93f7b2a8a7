// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/pair_limits.h"

#include "engine/core/error.h"
#include "engine/solvers/shared_constants.h"

#include <fmt/format.h>

#include <cmath>

namespace episcope {
PairLimits::PairLimits(int height, int width, double weight, ImageView<const float> g)
    : pitch_(layer_pitch(width)),
      memory_(static_cast<std::size_t>(height) * kPairKinds * pitch_ + 2 * kLayerRowUnit) {
  for (int y = 0; y < height; ++y) {
    const bool down = y + 1 < height;
    // The share of diagonals missing above the first row and below the last one.
    const float along =
        kPairSide + kPairDiagonal * static_cast<float>((y == 0 ? 1 : 0) + (down ? 0 : 1));
    for (int x = 0; x < width; ++x) {
      const bool right = x + 1 < width;
      const float aside =
          kPairSide + kPairDiagonal * static_cast<float>((x == 0 ? 1 : 0) + (right ? 0 : 1));
      const float here = static_cast<float>(weight) * (g.empty() ? 1.0F : g.at(y, x));
      const float diagonal = right && down ? here * kPairDiagonal : 0;
      memory_[begin_of(y, 0) + x] = right ? here * along : 0;
      memory_[begin_of(y, 1) + x] = down ? here * aside : 0;
      memory_[begin_of(y, 2) + x] = diagonal;
      memory_[begin_of(y, 3) + x] = diagonal;
    }
  }
}

void take_cheapest(VolumeView<const float> cost, int y, int* labels, std::vector<float>& least) {
  least.assign(cost.row(y, 0), cost.row(y, 0) + cost.width);
  std::fill_n(labels, cost.width, 0);
  for (int l = 1; l < cost.layers; ++l) {
    const float* const row = cost.row(y, l);
    for (int x = 0; x < cost.width; ++x) {
      labels[x] = row[x] < least[x] ? l : labels[x];
      least[x] = std::min(least[x], row[x]);
    }
  }
}

void check_boundaries(ImageView<const float> g, double smoothness, int height, int width) {
  if (!g.empty() && (g.height != height || g.width != width || g.channels != 1)) {
    throw InvalidInput(fmt::format("a labeling needs edge weights of {} by {} pixels, not {} by {}",
                                   width, height, g.width, g.height));
  }
  if (!(smoothness >= 0)) throw InvalidInput("the smoothness of a labeling must not be negative");
}

double labeling_gap(double energy, double bound) {
  if (energy == bound) return 0;
  return energy == 0 ? 1 : (energy - bound) / std::abs(energy);
}

std::string labeling_gap_text(double gap) {
  return fmt::format("labeling, gap {:.1e}", gap);
}

}  // namespace episcope
