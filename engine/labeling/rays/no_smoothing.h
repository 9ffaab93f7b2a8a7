// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/labeling/rays/ray_labeling.h"

namespace episcope {

/// The most probable label of each ray of all views, and of one view, without any coupling. Energy
/// and bound are 0. Throws Cancelled.
[[nodiscard]] RayLabeling most_probable_labels_of_all(const RayLabelingInput& input,
                                                      const RayLabelingParameters& parameters,
                                                      const Progress& progress);
[[nodiscard]] RayLabeling most_probable_labels_of_view(const RayLabelingInput& input,
                                                       ViewIndex view,
                                                       const RayLabelingParameters& parameters,
                                                       const Progress& progress);

}  // namespace episcope
