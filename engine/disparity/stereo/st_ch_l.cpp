// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo/st_ch_l.h"

#include "engine/disparity/stereo/stereo_local.h"

namespace episcope {

Estimator st_ch_l_estimator() {
  return make_estimator<StereoLocalParameters>(
      {"st_ch_l", "ST_CH_L", "Multi-view stereo over the views of the cross-hair, local",
       "Wanner, Meister and Goldluecke 2013 [WMG13]", false, false, 3},
      stereo_local_schema(MatchedViews::CrossHair),
      [](const LightField& light_field, const StereoLocalParameters& parameters, ViewSelection,
         const Progress& progress) {
        return estimate_stereo_local(light_field, MatchedViews::CrossHair, parameters, progress);
      });
}

}  // namespace episcope
