// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo/stereo_global.h"

#include "engine/disparity/common/cost_unit.h"
#include "engine/disparity/common/local_noise.h"
#include "engine/disparity/stereo/volume_trust.h"

namespace episcope {

Schema<StereoGlobalParameters> stereo_global_schema(MatchedViews views) {
  using P = StereoGlobalParameters;
  return Schema<P>()
      .part(&P::labeling, global_labeling_schema())
      .part(&P::matching, stereo_cost_schema(views))
      .begin_with(kProfileKey)
      .search("smoothness", {0.3, 0.6, 1.2, 2.4, 5, 10})
      .search("edge_strength", {0, 25})
      .search("epsilon", {0, 0.02, 0.05, kUncapped})
      .preset(kProfileKey, kPaperProfile, plain_labeling())
      .preset(kProfileKey, kPaperProfile, {{"smoothness", kPaperSmoothness}})
      .preset_search(kProfileKey, kPaperProfile, "smoothness",
                     {0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.2, 1.6, 2.4});
}

Estimate estimate_stereo_global(const LightField& lf, MatchedViews views,
                                const StereoGlobalParameters& parameters, const Progress& progress,
                                Device) {
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
    return place_by_costs(stereo, costs, means, y, x, label);
  };
  const double scale = cost_unit(lf, stereo.view, costs, step, progress.part(0.31, 0.32));
  const double noise = view_noise_variance(lf, stereo.view, progress.part(0.32, 0.321));
  label_globally(lf, {stereo.view, stereo.labels, costs, scale, place, noise}, parameters.labeling,
                 estimate, progress.part(0.321, 0.99));
  estimate.confidence = volume_confidence(estimate.field.disparity.view(stereo.view), stereo, costs,
                                          means, progress.part(0.99, 1));
  return estimate;
}

}  // namespace episcope
