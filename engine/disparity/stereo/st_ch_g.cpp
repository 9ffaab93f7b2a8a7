// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo/st_ch_g.h"

#include "engine/disparity/stereo/stereo_global.h"

namespace episcope {

Estimator st_ch_g_estimator() {
  return make_estimator<StereoGlobalParameters>(
      {"st_ch_g", "ST_CH_G", "Globally optimal labeling on the matching costs of ST_CH_L",
       "Wanner, Meister and Goldluecke 2013 [WMG13]", false, true, 3},
      stereo_global_schema(MatchedViews::CrossHair),
      [](const LightField& light_field, const StereoGlobalParameters& parameters, ViewSelection,
         const Progress& progress) {
        return estimate_stereo_global(light_field, MatchedViews::CrossHair, parameters, progress);
      });
}

}  // namespace episcope
