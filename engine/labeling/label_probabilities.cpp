// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/label_probabilities.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace episcope {

LabelProbabilities empty_probabilities(const std::vector<std::int32_t>& ids, ViewRectangle views) {
  LabelProbabilities probabilities;
  probabilities.ids = ids;
  probabilities.grid = views.grid;
  probabilities.first = views.first;
  probabilities.views.resize(static_cast<std::size_t>(views.grid.count()));
  return probabilities;
}

Image<std::int32_t> most_probable_labels(VolumeView<const std::uint8_t> probabilities,
                                         const std::vector<std::int32_t>& ids) {
  if (static_cast<int>(ids.size()) != probabilities.layers) {
    throw InvalidInput(fmt::format("there are {} label ids for {} layers of probabilities",
                                   ids.size(), probabilities.layers));
  }
  Image<std::int32_t> labels(probabilities.height, probabilities.width);
  std::vector<std::uint8_t> best(probabilities.width);
  for (int y = 0; y < probabilities.height; ++y) {
    std::int32_t* out = labels.row(y);
    const std::uint8_t* first = probabilities.row(y, 0);
    best.assign(first, first + probabilities.width);
    std::fill_n(out, probabilities.width, ids[0]);
    for (int layer = 1; layer < probabilities.layers; ++layer) {
      const std::uint8_t* p = probabilities.row(y, layer);
      for (int x = 0; x < probabilities.width; ++x) {
        if (p[x] <= best[x]) continue;
        best[x] = p[x];
        out[x] = ids[layer];
      }
    }
  }
  return labels;
}

Image<float> label_uncertainty(VolumeView<const std::uint8_t> probabilities) {
  Image<float> uncertainty(probabilities.height, probabilities.width);
  if (probabilities.layers < 2) return uncertainty;
  const float full = std::log(static_cast<float>(probabilities.layers));
  std::vector<float> sum(probabilities.width);
  std::vector<float> sum_log(probabilities.width);  // of p log p
  for (int y = 0; y < probabilities.height; ++y) {
    std::fill(sum.begin(), sum.end(), 0.F);
    std::fill(sum_log.begin(), sum_log.end(), 0.F);
    for (int layer = 0; layer < probabilities.layers; ++layer) {
      const std::uint8_t* p = probabilities.row(y, layer);
      for (int x = 0; x < probabilities.width; ++x) {
        if (p[x] == 0) continue;
        sum[x] += p[x];
        sum_log[x] += p[x] * std::log(static_cast<float>(p[x]));
      }
    }
    for (int x = 0; x < probabilities.width; ++x) {
      // Of p over its sum s: H = log s − (Σ p log p) / s; nothing known at all is full entropy.
      const float entropy = sum[x] > 0 ? std::log(sum[x]) - sum_log[x] / sum[x] : full;
      uncertainty.at(y, x) = std::fmin(std::fmax(entropy / full, 0.F), 1.F);
    }
  }
  return uncertainty;
}

}  // namespace episcope
