// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/label_support.h"

#include "engine/core/array/volume.h"
#include "engine/core/parallel/parallel.h"
#include "engine/disparity/common/matching_cost.h"

#include <algorithm>
#include <numeric>

namespace episcope {
namespace {

constexpr int kRows = 64;
// Beyond it a view does not show the point.
constexpr double kCap = 0.3;
// Costs that differ by less, in samples of [0, 1], say nothing.
constexpr float kContrast = 0.004F;

// Adds the pixels of a row to the labels that they match best.
void count_best(VolumeView<const float> costs, const LightField& lf, int y, double* counts) {
  for (int x = 0; x < costs.width; ++x) {
    if (!lf.is_valid(lf.center(), y, x)) continue;
    int best = 0;
    float most = costs.at(0, 0, x);
    for (int l = 1; l < costs.layers; ++l) {
      const float cost = costs.at(0, l, x);
      if (cost < costs.at(0, best, x)) best = l;
      most = std::max(most, cost);
    }
    if (most - costs.at(0, best, x) > kContrast) counts[best] += 1;
  }
}

}  // namespace

std::vector<double> label_support(const LightField& lf, const std::vector<float>& labels,
                                  const Progress& progress) {
  const MatchingCost cost{MatchedViews::CrossHair, Interpolation::Bilinear, kCap};
  const int count = static_cast<int>(labels.size());
  const int rows = std::min(kRows, lf.height());
  std::vector<double> counts(static_cast<std::size_t>(rows) * count);
  parallel_for_workers(rows, progress, [&] {
    return [&, matching = MatchingCostRows(lf, lf.center(), cost, labels),
            costs = Volume<float>(1, count, lf.width())](int i) mutable {
      const int y = rows > 1 ? i * (lf.height() - 1) / (rows - 1) : 0;
      matching.compute(y, costs.view(), progress);
      count_best(costs.view(), lf, y, counts.data() + static_cast<std::size_t>(i) * count);
    };
  });
  std::vector<double> shares(count);
  for (std::size_t i = 0; i < counts.size(); ++i) shares[i % count] += counts[i];
  const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= std::max(total, 1.0);
  return shares;
}

}  // namespace episcope
