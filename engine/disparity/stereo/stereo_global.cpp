// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo/stereo_global.h"

#include "engine/core/parallel/parallel.h"
#include "engine/disparity/common/cost_unit.h"
#include "engine/disparity/common/sub_label.h"

#include <algorithm>
#include <vector>

namespace episcope {
namespace {

// No pixel gets weight 0 when it is placed between labels.
constexpr float kMinWeight = 0.01F;

// The mean cost of each pixel over the labels.
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

float confidence_of(float cost, float mean) {
  return mean > 0 ? std::clamp(1 - cost / mean, 0.0F, 1.0F) : 0;
}

// Of each pixel, by the cost of the label nearest to its disparity.
ViewStack<float> confidence_map(const Estimate& estimate, const StereoCosts& stereo,
                                VolumeView<const float> costs, const Image<float>& means,
                                const Progress& progress) {
  ViewStack<float> confidence({1, 1}, costs.height, costs.width, 1, stereo.view);
  const ImageView<const float> disparity = estimate.field.disparity.view(stereo.view);
  const ImageView<float> map = confidence.view(stereo.view);
  const float step = stereo.labels[1] - stereo.labels[0];
  parallel_for(costs.height, progress, [&](int y) {
    for (int x = 0; x < costs.width; ++x) {
      const float place = (disparity.at(y, x) - stereo.labels.front()) / step;
      const int label = std::clamp(static_cast<int>(place + 0.5F), 0, costs.layers - 1);
      map.at(y, x) = confidence_of(costs.at(y, label, x), means.at(y, x));
    }
  });
  return confidence;
}

}  // namespace

Schema<StereoGlobalParameters> stereo_global_schema(MatchedViews views) {
  using P = StereoGlobalParameters;
  return Schema<P>()
      .part(&P::labeling, global_labeling_schema())
      .part(&P::matching, stereo_cost_schema(views))
      .begin_with(kProfileKey)
      .search("smoothness", {0.3, 0.6, 1.2, 2.4, 5, 10})
      .search("edge_strength", {0, 20})
      .search("epsilon", {0, 0.02, 0.05, kUncapped})
      .preset(kProfileKey, kPaperProfile, plain_labeling())
      .preset(kProfileKey, kPaperProfile, {{"smoothness", kPaperSmoothness}})
      .preset_search(kProfileKey, kPaperProfile, "smoothness",
                     {0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.2, 1.6, 2.4});
}

Estimate estimate_stereo_global(const LightField& lf, MatchedViews views,
                                const StereoGlobalParameters& parameters,
                                const Progress& progress) {
  const StereoCosts stereo = prepare_stereo(lf, views, parameters.matching, progress.part(0, 0.05));
  progress.step("matching costs");
  const Volume<float> volume = stereo_volume(lf, stereo, progress.part(0.05, 0.3));
  const VolumeView<const float> costs = volume.view();
  const Image<float> means = mean_costs(costs, progress.part(0.3, 0.31));
  Estimate estimate;
  estimate.range = stereo.range;
  estimate.notes = cost_notes(stereo);
  const float step = stereo.labels[1] - stereo.labels[0];
  const auto place = [&](int y, int x, int label) {
    const float cost = costs.at(y, label, x);
    const float trust = confidence_of(cost, means.at(y, x));
    float offset = 0;
    if (label > 0 && label + 1 < costs.layers) {
      offset = sub_label_offset(costs.at(y, label - 1, x), cost, costs.at(y, label + 1, x),
                                Refinement::Parabola);
    }
    return Placement{stereo.labels[label] + offset * step, std::max(trust * trust, kMinWeight)};
  };
  const double scale = cost_unit(lf, stereo.view, costs, step, progress.part(0.31, 0.32));
  label_globally(lf, {stereo.view, stereo.labels, costs, scale, place}, parameters.labeling,
                 estimate, progress.part(0.32, 0.99));
  estimate.confidence = confidence_map(estimate, stereo, costs, means, progress.part(0.99, 1));
  return estimate;
}

}  // namespace episcope
