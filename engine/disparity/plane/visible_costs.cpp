// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/visible_costs.h"

#include "engine/core/parallel/parallel.h"
#include "engine/disparity/plane/local_caps.h"
#include "engine/disparity/plane/regional_trust.h"
#include "engine/disparity/stereo/stereo_on_device.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace episcope {
namespace {

// Between a view that counts and one that does not, px of disparity.
constexpr float kSoftness = 0.05F;

// Of the view, which is compensated.
Image<float> noise_of(const StereoCosts& costs, const Progress& progress) {
  if (costs.matcher) return costs.matcher->noise(progress);
  return costs.matching.noise ? *costs.matching.noise : Image<float>();
}

LabelCosts costs_on_device(const LightField& lf, const StereoCosts& costs,
                           const Progress& progress) {
  const LightField& compared = costs.relative ? *costs.relative : lf;
  return {costs,
          costs.matcher->volume(device_matching(compared, costs.view, costs.matching, costs.labels),
                                progress)};
}

}  // namespace

Schema<VisibilityParameters> visibility_schema() {
  using P = VisibilityParameters;
  return Schema<P>()
      .integer("rounds", &P::rounds,
               {"Rounds",
                "Number of times the costs are computed again without the views in which the "
                "last result says a point is occluded; 0 = off"},
               {0, 10})
      .real("tolerance", &P::tolerance,
            {"Tolerance", "A surface nearer than a point by more than this occludes it", "px"},
            {0, 2})
      .real("least_trust", &P::least_trust,
            {"Least confidence",
             "A surface whose confidence is below this, mean over its surroundings, occludes "
             "nothing"},
            {0, 1})
      .real("cap_share", &P::cap_share, {"Least cap", "The least cap of a pixel, as a share of ε"},
            {0, 10})
      .real("cap_offset", &P::cap_offset,
            {"Cap offset",
             "The cap of a pixel follows what a disparity that is off by this much costs there; 0 "
             "uses ε for all pixels",
             "px"},
            {0, 2});
}

void set_local_caps(const LightField& lf, const VisibilityParameters& parameters,
                    const Progress& progress, StereoCosts& costs) {
  if (parameters.cap_offset <= 0) return;
  const Image<float> noise = noise_of(costs, progress.part(0, 0));
  if (noise.empty()) return;
  auto caps = std::make_shared<Image<float>>(local_caps(
      lf, costs.view, noise, {.offset = static_cast<float>(parameters.cap_offset)}, progress));
  const auto least = static_cast<float>(parameters.cap_share * costs.matching.cap);
  for (float& cap : *caps) cap = std::max(cap, least);
  if (costs.matcher) costs.matcher->set_caps(*caps, progress.part(1, 1));
  costs.matching.caps = std::move(caps);
}

Image<float> sure_surfaces(ImageView<const float> disparity, ImageView<const float> confidence,
                           double least_trust) {
  const Image<float> trust = regional_trust(confidence);
  Image<float> known(disparity.height, disparity.width, 1, kNothingNear);
  for (int y = 0; y < disparity.height; ++y) {
    for (int x = 0; x < disparity.width; ++x) {
      if (trust.at(y, x) >= least_trust) known.at(y, x) = disparity.at(y, x);
    }
  }
  return known;
}

void set_occluders(const LightField& lf, ImageView<const float> disparity,
                   ImageView<const float> confidence, const VisibilityParameters& parameters,
                   const Progress& progress, StereoCosts& costs) {
  const Image<float> known = sure_surfaces(disparity, confidence, parameters.least_trust);
  if (costs.matcher) {
    return costs.matcher->set_occluders(known, static_cast<float>(parameters.tolerance), kSoftness,
                                        progress);
  }
  auto occluders = std::make_shared<Occluders>();
  occluders->nearest = surfaces_in_views(known, costs.view, lf.grid(), progress);
  occluders->tolerance = static_cast<float>(parameters.tolerance);
  occluders->softness = kSoftness;
  costs.matching.occluders = std::move(occluders);
}

LabelCosts visible_costs(const LightField& lf, const StereoCosts& costs, const Progress& progress) {
  if (costs.matcher) return costs_on_device(lf, costs, progress);
  Volume<float> volume = stereo_volume(lf, costs, progress.part(0, 0.9));
  if (!costs.matching.caps) return {costs, std::move(volume), progress.part(0.95, 1)};
  const Image<float>& caps = *costs.matching.caps;
  const auto mean = static_cast<float>(std::accumulate(caps.begin(), caps.end(), 0.0) /
                                       static_cast<double>(caps.size()));
  const VolumeView<float> view = volume.view();
  parallel_for(view.height, progress.part(0.9, 0.95), [&](int y) {
    const float* const cap = caps.row(y);
    for (int label = 0; label < view.layers; ++label) {
      float* const cost = view.row(y, label);
      for (int x = 0; x < view.width; ++x) cost[x] *= mean / cap[x];
    }
  });
  return {costs, std::move(volume), progress.part(0.95, 1)};
}

}  // namespace episcope
