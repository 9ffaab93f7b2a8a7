// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo/st_av_l.h"

#include "engine/disparity/stereo/stereo_local.h"

namespace episcope {

Estimator st_av_l_estimator() {
  return make_estimator<StereoLocalParameters>(
      {"st_av_l", "ST_AV_L", "Multi-view stereo over all views, local",
       "Wanner, Meister and Goldluecke 2013 [WMG13]", false, false, 3},
      stereo_local_schema(MatchedViews::All),
      [](const LightField& light_field, const StereoLocalParameters& parameters, ViewSelection,
         const Progress& progress) {
        return estimate_stereo_local(light_field, MatchedViews::All, parameters, progress);
      });
}

}  // namespace episcope
