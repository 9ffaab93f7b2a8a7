// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo/st_ch_s.h"

#include "engine/disparity/stereo/stereo_local.h"

namespace episcope {

Estimator st_ch_s_estimator() {
  return make_estimator<StereoSmoothParameters>(
      {"st_ch_s", "ST_CH_S", "ST_CH_L, denoised with total variation (TV-L2)",
       "Wanner, Meister and Goldluecke 2013 [WMG13]", false, true, 3},
      stereo_smooth_schema(MatchedViews::CrossHair),
      [](const LightField& light_field, const StereoSmoothParameters& parameters, ViewSelection,
         const Progress& progress) {
        return estimate_stereo_smooth(light_field, MatchedViews::CrossHair, parameters, progress);
      });
}

}  // namespace episcope
