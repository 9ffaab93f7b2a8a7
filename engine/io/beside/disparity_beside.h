// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/io/beside/beside_views.h"

namespace episcope::io {

/// Disparity found beside views, in px per view step, positive = nearer, in the stored order of
/// views.
struct DisparityBeside {
  DisparityField field;          ///< Empty if there is none that can be used.
  CameraGrid camera;             ///< That of the views, or what disparity and depth say together.
  bool is_sign_assumed = false;  ///< Nothing tells near from far.
};

/// Reads disparity maps, else depth maps where the camera is known. Unit and sign are checked: by
/// warping views next to the centre (`settle_unit`), by what hides what (`find_near_side`), and by
/// depth maps; what was found, with the numbers, goes to `units` and `units_check` of the report.
/// Maps that are damaged or do not fit are left out with a warning. Throws Cancelled.
[[nodiscard]] DisparityBeside read_disparity_beside(const std::vector<MapSet>& sets,
                                                    const BesideViews& views,
                                                    const BesideNotes& notes,
                                                    const Progress& progress);

}  // namespace episcope::io
