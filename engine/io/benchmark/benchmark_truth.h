// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/beside/beside_views.h"

#include <filesystem>

namespace episcope::io {

/// Disparity by the names of the 2016 benchmark, `gt_disp_lowres_Cam*.pfm` of all views, else
/// `gt_disp_lowres.pfm` or, where the camera is known, `gt_depth_lowres.pfm` of the centre view, as
/// disparity with the sign of the benchmark: larger is nearer. Empty if there is none. Files that
/// are damaged or do not fit are left out with a warning, and their views are invalid. Throws
/// Cancelled.
[[nodiscard]] DisparityField read_benchmark_disparity(const std::filesystem::path& folder,
                                                      const BesideViews& views,
                                                      const BesideNotes& notes,
                                                      const Progress& progress);

/// Adds labels, region masks and the truth in high resolution to `truth`; leaves out likewise.
void read_benchmark_masks(const std::filesystem::path& folder, const BesideViews& views,
                          const BesideNotes& notes, GroundTruth& truth);

}  // namespace episcope::io
