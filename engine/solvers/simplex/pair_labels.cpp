// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/simplex/pair_labels.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <cmath>

namespace episcope {

void take_cheapest(VolumeView<const float> cost, int y, int* labels, std::vector<float>& least) {
  least.assign(cost.row(y, 0), cost.row(y, 0) + cost.width);
  std::fill_n(labels, cost.width, 0);
  for (int l = 1; l < cost.layers; ++l) {
    const float* const row = cost.row(y, l);
    for (int x = 0; x < cost.width; ++x) {
      if (!(row[x] < least[x])) continue;
      least[x] = row[x];
      labels[x] = l;
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
  return energy == bound ? 0 : (energy - bound) / std::abs(energy);
}

std::string labeling_gap_text(double gap) {
  return fmt::format("labeling, gap {:.1e}", gap);
}

}  // namespace episcope
