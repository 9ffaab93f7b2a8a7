// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/plane_parameters.h"

namespace episcope {

Schema<PlaneParameters> plane_pm_schema() {
  using P = PlaneParameters;
  return Schema<P>()
      .part(&P::visibility, visibility_schema())
      .part(&P::refinement, plane_refinement_schema())
      .part(&P::labeling, jump_labeling_schema())
      .part(&P::matching, stereo_matching_schema())
      .flag("even", &P::even,
            {"Even brightness",
             "Correct differences in brightness between the views, and their fall-off to the "
             "corners, where there are any"})
      .flag("silhouettes", &P::silhouettes,
            {"Place silhouettes",
             "Beside jumps, take the median of the surroundings, weighted by likeness of colour"})
      .part(&P::islands, island_schema())
      .search("smoothness", {0.75, 1.5, 3})
      .search("rounds", {0, 1, 2});
}

}  // namespace episcope
