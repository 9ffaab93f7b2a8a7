// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/label_costs.h"

#include "engine/core/parallel/parallel.h"
#include "engine/cuda/stereo/volume_costs.h"
#include "engine/disparity/stereo/volume_trust.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace episcope {

LabelCosts::LabelCosts(const StereoCosts& stereo, Volume<float> volume, const Progress& progress)
    : stereo_(stereo),
      volume_(std::move(volume)),
      means_(mean_costs(std::as_const(volume_).view(), progress)) {}

LabelCosts::LabelCosts(const StereoCosts& stereo, cuda::SharedVolume volume)
    : stereo_(stereo), on_device_(std::move(volume)) {}

Image<int> LabelCosts::best_labels(const Progress& progress) const {
  if (on_device_) return cuda::least_labels(*on_device_, progress);
  const VolumeView<const float> costs = on_cpu();
  Image<int> labels(costs.height, costs.width);
  parallel_for(costs.height, progress, [&](int y) {
    std::vector<float> least(costs.row(y, 0), costs.row(y, 0) + costs.width);
    int* const best = labels.row(y);
    for (int l = 1; l < costs.layers; ++l) {
      const float* const cost = costs.row(y, l);
      for (int x = 0; x < costs.width; ++x) {
        best[x] = cost[x] < least[x] ? l : best[x];
        least[x] = std::min(least[x], cost[x]);
      }
    }
  });
  return labels;
}

Placements LabelCosts::place(const Image<int>& labels, const Progress& progress) const {
  if (on_device_) return place_by_costs(stereo_, *on_device_, labels, progress);
  return place_pixels(
      labels,
      [&](int y, int x, int label) {
        return place_by_costs(stereo_, on_cpu(), means_, y, x, label);
      },
      progress);
}

ViewStack<float> LabelCosts::confidence(ImageView<const float> disparity,
                                        const Progress& progress) const {
  if (on_device_) return volume_confidence(disparity, stereo_, *on_device_, progress);
  return volume_confidence(disparity, stereo_, on_cpu(), means_, progress);
}

}  // namespace episcope
