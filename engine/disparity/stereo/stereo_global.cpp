// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo/stereo_global.h"

#include "engine/disparity/common/cost_unit.h"
#include "engine/disparity/common/local_noise.h"
#include "engine/disparity/stereo/stereo_on_device.h"
#include "engine/disparity/stereo/volume_trust.h"

namespace episcope {

Schema<StereoGlobalParameters> stereo_global_schema(MatchedViews views) {
  using P = StereoGlobalParameters;
  return Schema<P>()
      .part(&P::labeling, global_labeling_schema())
      .part(&P::matching, stereo_cost_schema(views))
      .part(&P::islands, island_schema())
      .begin_with(kProfileKey)
      .search("smoothness", {0.3, 0.6, 1.2, 2.4, 5, 10})
      .search("edge_strength", {0, 25})
      .search("epsilon", {0, 0.02, 0.05, kUncapped})
      .preset(kProfileKey, kPaperProfile, plain_labeling())
      .preset(kProfileKey, kPaperProfile, plain_islands())
      .preset(kProfileKey, kPaperProfile, {{"smoothness", kPaperSmoothness}})
      .preset_search(kProfileKey, kPaperProfile, "smoothness",
                     {0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.2, 1.6, 2.4});
}

namespace {

void label_costs(const LightField& lf, const StereoCosts& stereo,
                 const GlobalLabelingParameters& labeling, Estimate& estimate,
                 const Progress& progress) {
  const Volume<float> volume = stereo_volume(lf, stereo, progress.part(0, 0.26));
  const VolumeView<const float> costs = volume.view();
  const Image<float> means = mean_costs(costs, progress.part(0.26, 0.27));
  const auto place = [&](const Image<int>& labels, const Progress& part) {
    return place_pixels(
        labels,
        [&](int y, int x, int label) { return place_by_costs(stereo, costs, means, y, x, label); },
        part);
  };
  const float step = stereo.labels[1] - stereo.labels[0];
  const double scale = cost_unit(lf, stereo.view, costs, step, progress.part(0.27, 0.28));
  const double noise = view_noise_variance(lf, stereo.view, progress.part(0.28, 0.281));
  label_globally(lf, {stereo.view, stereo.labels, costs, scale, place, noise, {}}, labeling,
                 estimate, progress.part(0.281, 0.99));
  estimate.confidence = volume_confidence(estimate.field.disparity.view(stereo.view), stereo, costs,
                                          means, progress.part(0.99, 1));
}

void label_on_device(const LightField& lf, const StereoCosts& stereo,
                     const GlobalLabelingParameters& labeling, Estimate& estimate,
                     const Progress& progress) {
  const LightField& compared = stereo.relative ? *stereo.relative : lf;
  const cuda::SharedVolume costs =
      stereo.matcher->volume(device_matching(compared, stereo.view, stereo.matching, stereo.labels),
                             progress.part(0, 0.26));
  const auto place = [&](const Image<int>& labels, const Progress& part) {
    return place_by_costs(stereo, *costs, labels, part);
  };
  const float step = stereo.labels[1] - stereo.labels[0];
  const double scale = cost_unit(lf, stereo.view, *costs, step, progress.part(0.26, 0.28));
  const double noise = stereo.matcher->noise_variance(progress.part(0.28, 0.281));
  label_globally(lf, {stereo.view, stereo.labels, {}, scale, place, noise, costs}, labeling,
                 estimate, progress.part(0.281, 0.99));
  estimate.confidence = volume_confidence(estimate.field.disparity.view(stereo.view), stereo,
                                          *costs, progress.part(0.99, 1));
}

}  // namespace

Estimate estimate_stereo_global(const LightField& lf, MatchedViews views,
                                const StereoGlobalParameters& parameters, const Progress& progress,
                                Device device) {
  const StereoCosts stereo =
      prepare_stereo(lf, views, parameters.matching, progress.part(0, 0.05), device);
  progress.step("matching costs");
  Estimate estimate;
  estimate.range = stereo.range;
  estimate.notes = cost_notes(stereo);
  const auto label = stereo.matcher ? label_on_device : label_costs;
  label(lf, stereo, parameters.labeling, estimate, progress.part(0.05, 1));
  fill_islands(parameters.islands, progress.part(1, 1), estimate.field.disparity.view(stereo.view));
  return estimate;
}

}  // namespace episcope
