// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"
#include "engine/labeling/ray_labeling.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace episcope::test {

/// The ids of a scene's true labels, ascending.
inline std::vector<std::int32_t> label_ids(const ViewStack<std::int32_t>& labels) {
  std::vector<std::int32_t> ids(labels.data(), labels.data() + labels.size());
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

/// What a classifier would say that takes `share` of all rays for another label, at random, and
/// knows it. With a single true label, 99 is the other one.
inline LabelProbabilities mistaken(const ViewStack<std::int32_t>& truth, double share) {
  LabelProbabilities p{label_ids(truth), truth.grid(), truth.first(), {}};
  if (p.ids.size() < 2) p.ids.push_back(99);
  const int layers = static_cast<int>(p.ids.size());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < p.grid.count(); ++i) {
    const auto labels =
        truth.view({truth.first().v + i / p.grid.u, truth.first().u + i % p.grid.u});
    ProbabilityMap map(truth.height(), layers, truth.width());
    for (int y = 0; y < truth.height(); ++y) {
      for (int x = 0; x < truth.width(); ++x) {
        const auto id = std::ranges::find(p.ids, labels.at(y, x));
        int told = static_cast<int>(id - p.ids.begin());
        if (uniform(random) < share) {
          told = (told + 1 + static_cast<int>(uniform(random) * (layers - 1))) % layers;
        }
        for (int l = 0; l < layers; ++l) {
          const double probability = l == told ? 1 - share : share / (layers - 1);
          map.view().at(y, l, x) = static_cast<std::uint8_t>(255 * probability + 0.5);
        }
      }
    }
    p.views.push_back(std::move(map));
  }
  return p;
}

/// Fraction of rays labeled correctly, over all views that `labels` holds.
inline double accuracy(const ViewStack<std::int32_t>& labels,
                       const ViewStack<std::int32_t>& truth) {
  std::size_t right = 0;
  for (int i = 0; i < labels.grid().count(); ++i) {
    const ViewIndex view{labels.first().v + i / labels.grid().u,
                         labels.first().u + i % labels.grid().u};
    const auto here = labels.view(view), exact = truth.view(view);
    for (std::size_t k = 0; k < labels.view_size(); ++k) right += here.data[k] == exact.data[k];
  }
  return static_cast<double>(right) / static_cast<double>(labels.size());
}

}  // namespace episcope::test
