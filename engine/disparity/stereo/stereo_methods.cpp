// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo/stereo_methods.h"

#include "engine/disparity/stereo/stereo_global.h"
#include "engine/disparity/stereo/stereo_local.h"

namespace episcope {
namespace {

constexpr const char* kReference = "Wanner, Meister and Goldluecke 2013 [WMG13]";

template <class P>
using StereoFunction = Estimate (*)(const LightField&, MatchedViews, const P&, const Progress&,
                                    Device);

// `estimate` of `views`, in the form that make_estimator takes.
template <class P>
auto with_views(MatchedViews views, StereoFunction<P> estimate) {
  return [=](const LightField& light_field, const P& parameters, ViewSelection,
             const Progress& progress,
             Device device) { return estimate(light_field, views, parameters, progress, device); };
}

// A method from its schema and its function of `views`.
template <class P>
Estimator stereo_estimator(EstimatorInfo info, MatchedViews views,
                           Schema<P> (*schema)(MatchedViews), StereoFunction<P> estimate) {
  info.devices = {Device::Cpu, Device::Cuda};
  return make_estimator<P>(std::move(info), schema(views), with_views(views, estimate));
}

template <class P>
using StereoBlocks = BlockwiseRun (*)(const LightField&, MatchedViews, const P&, const Progress&);

// One that can also run in blocks.
template <class P>
Estimator stereo_estimator(EstimatorInfo info, MatchedViews views,
                           Schema<P> (*schema)(MatchedViews), StereoFunction<P> estimate,
                           StereoBlocks<P> blocks) {
  info.devices = {Device::Cpu, Device::Cuda};
  return make_estimator<P>(
      std::move(info), schema(views), with_views(views, estimate),
      [=](const LightField& light_field, const P& parameters, ViewSelection,
          const Progress& progress) { return blocks(light_field, views, parameters, progress); });
}

Estimator local_estimator(EstimatorInfo info, MatchedViews views) {
  return stereo_estimator<StereoLocalParameters>(std::move(info), views, stereo_local_schema,
                                                 estimate_stereo_local, stereo_local_in_blocks);
}

}  // namespace

Estimator st_av_l_estimator() {
  return local_estimator({.id = "st_av_l",
                          .name = "ST_AV_L",
                          .summary = "Local multi-view stereo over all views",
                          .reference = kReference,
                          .revision = 5},
                         MatchedViews::All);
}

Estimator st_ch_l_estimator() {
  return local_estimator({.id = "st_ch_l",
                          .name = "ST_CH_L",
                          .summary = "Local multi-view stereo over the views of the cross-hair",
                          .reference = kReference,
                          .revision = 5},
                         MatchedViews::CrossHair);
}

Estimator st_av_s_estimator() {
  return stereo_estimator({.id = "st_av_s",
                           .name = "ST_AV_S",
                           .summary = "ST_AV_L, denoised with total variation (TV-L2)",
                           .reference = kReference,
                           .iterative = true,
                           .revision = 6},
                          MatchedViews::All, stereo_smooth_schema, estimate_stereo_smooth,
                          stereo_smooth_in_blocks);
}

Estimator st_ch_s_estimator() {
  return stereo_estimator({.id = "st_ch_s",
                           .name = "ST_CH_S",
                           .summary = "ST_CH_L, denoised with total variation (TV-L2)",
                           .reference = kReference,
                           .iterative = true,
                           .revision = 6},
                          MatchedViews::CrossHair, stereo_smooth_schema, estimate_stereo_smooth,
                          stereo_smooth_in_blocks);
}

Estimator st_av_g_estimator() {
  return stereo_estimator({.id = "st_av_g",
                           .name = "ST_AV_G",
                           .summary = "Globally optimal labeling of the matching costs of ST_AV_L",
                           .reference = kReference,
                           .iterative = true,
                           .revision = 6},
                          MatchedViews::All, stereo_global_schema, estimate_stereo_global);
}

Estimator st_ch_g_estimator() {
  return stereo_estimator({.id = "st_ch_g",
                           .name = "ST_CH_G",
                           .summary = "Globally optimal labeling of the matching costs of ST_CH_L",
                           .reference = kReference,
                           .iterative = true,
                           .revision = 6},
                          MatchedViews::CrossHair, stereo_global_schema, estimate_stereo_global);
}

}  // namespace episcope
