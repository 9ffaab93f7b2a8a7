// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo/st_av_g.h"

#include "engine/disparity/stereo/stereo_global.h"

namespace episcope {

Estimator st_av_g_estimator() {
  return make_estimator<StereoGlobalParameters>(
      {"st_av_g", "ST_AV_G", "Globally optimal labeling on the matching costs of ST_AV_L",
       "Wanner, Meister and Goldluecke 2013 [WMG13]", false, true, 3},
      stereo_global_schema(MatchedViews::All),
      [](const LightField& light_field, const StereoGlobalParameters& parameters, ViewSelection,
         const Progress& progress) {
        return estimate_stereo_global(light_field, MatchedViews::All, parameters, progress);
      });
}

}  // namespace episcope
