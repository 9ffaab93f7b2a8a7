// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/consistency.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/labeling/ray_targets.h"

#include <vector>

namespace episcope {
namespace {

struct Pair {
  ViewIndex from, to;
};

// Row by row, so that a stop request is seen.
LabelConsistency compare(const ViewStack<std::int32_t>& labels, const DisparityField& disparity,
                         const Pair& pair, const Progress& progress) {
  LabelConsistency found;
  const ViewIndex step{pair.to.v - pair.from.v, pair.to.u - pair.from.u};
  const auto here = labels.view(pair.from), there = labels.view(pair.to);
  const DisparityView from = disparity.view(pair.from), to = disparity.view(pair.to);
  std::vector<std::int32_t> targets(labels.width());
  for (int y = 0; y < labels.height(); ++y) {
    progress.check();
    find_ray_targets(from, to, step, y, targets.data());
    for (int x = 0; x < labels.width(); ++x) {
      if (targets[x] < 0) continue;
      ++found.visible;
      found.agreeing += here.at(y, x) == there.data[targets[x]] ? 1 : 0;
    }
  }
  found.pairs = static_cast<std::int64_t>(labels.view_size());
  return found;
}

}  // namespace

LabelConsistency label_consistency(const ViewStack<std::int32_t>& labels,
                                   const DisparityField& disparity, const Progress& progress) {
  if (labels.empty() || disparity.empty() || labels.height() != disparity.disparity.height() ||
      labels.width() != disparity.disparity.width()) {
    throw InvalidInput("consistency needs labels and disparities of the same size");
  }
  std::vector<Pair> pairs;
  const GridShape grid = labels.grid();
  const ViewIndex first = labels.first();
  const auto add = [&](ViewIndex from, ViewIndex to) {
    if (from == to || !disparity.contains(from) || !disparity.contains(to)) return;
    pairs.push_back({from, to});
  };
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex from = grid.view_at(i, first);
    for (int u = 0; u < grid.u; ++u) add(from, {from.v, first.u + u});
    for (int v = 0; v < grid.v; ++v) add(from, {first.v + v, from.u});
  }
  std::vector<LabelConsistency> parts(pairs.size());
  parallel_for(static_cast<int>(pairs.size()), progress,
               [&](int i) { parts[i] = compare(labels, disparity, pairs[i], progress); });
  LabelConsistency sum;
  for (const auto& part : parts) {
    sum.agreeing += part.agreeing;
    sum.visible += part.visible;
    sum.pairs += part.pairs;
  }
  return sum;
}

}  // namespace episcope
