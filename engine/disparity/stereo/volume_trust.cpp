// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo/volume_trust.h"

#include "engine/core/parallel/parallel.h"
#include "engine/disparity/common/invalid_pixels.h"
#include "engine/disparity/common/sub_label.h"

#include <algorithm>

namespace episcope {
namespace {

// No pixel gets weight 0 when it is placed between labels.
constexpr float kMinWeight = 0.01F;

}  // namespace

Image<float> mean_costs(VolumeView<const float> costs, const Progress& progress) {
  Image<float> means(costs.height, costs.width);
  parallel_for(costs.height, progress, [&](int y) {
    float* const mean = means.row(y);
    for (int l = 0; l < costs.layers; ++l) {
      const float* const cost = costs.row(y, l);
      for (int x = 0; x < costs.width; ++x) mean[x] += cost[x];
    }
    for (int x = 0; x < costs.width; ++x) mean[x] /= static_cast<float>(costs.layers);
  });
  return means;
}

float cost_trust(float cost, float mean) {
  return mean > 0 ? std::clamp(1 - cost / mean, 0.0F, 1.0F) : 0;
}

Placement place_by_costs(const StereoCosts& stereo, VolumeView<const float> costs,
                         const Image<float>& means, int y, int x, int label) {
  const float cost = costs.at(y, label, x);
  const float trust = cost_trust(cost, means.at(y, x));
  float offset = 0;
  if (label > 0 && label + 1 < costs.layers) {
    offset = sub_label_offset(costs.at(y, label - 1, x), cost, costs.at(y, label + 1, x),
                              Refinement::Parabola);
  }
  const float step = stereo.labels[1] - stereo.labels[0];
  return {stereo.labels[label] + offset * step, std::max(trust * trust, kMinWeight)};
}

ViewStack<float> volume_confidence(ImageView<const float> disparity, const StereoCosts& stereo,
                                   VolumeView<const float> costs, const Image<float>& means,
                                   const Progress& progress) {
  ViewStack<float> confidence({1, 1}, costs.height, costs.width, 1, stereo.view);
  const ImageView<float> map = confidence.view(stereo.view);
  const float step = stereo.labels[1] - stereo.labels[0];
  parallel_for(costs.height, progress, [&](int y) {
    for (int x = 0; x < costs.width; ++x) {
      const float place = (disparity.at(y, x) - stereo.labels.front()) / step;
      const int label = std::clamp(static_cast<int>(place + 0.5F), 0, costs.layers - 1);
      map.at(y, x) = cost_trust(costs.at(y, label, x), means.at(y, x));
    }
  });
  return confidence;
}

double mean_of_valid(const Image<float>& image, const LightField& lf, ViewIndex view) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) sum += lf.is_valid(view, y, x) ? image.at(y, x) : 0;
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, count_valid(lf, view)));
}

}  // namespace episcope
