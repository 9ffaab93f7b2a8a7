// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/blockwise.h"
#include "engine/disparity/common/run_options.h"
#include "engine/disparity/plane/plane_parameters.h"

namespace episcope {

/// The run of plane_pm (plane_pm.h) in blocks. Views are estimated one after the other, each of
/// which is kept when it is done; then all others are carried, view by view; then sides are chosen
/// in bands of rows of all views. Of a view at once it needs its costs and what occludes what;
/// these are large arrays, which go to disk beyond the memory budget (large_memory.h). Bands need
/// maps and samples of all views as far beyond them as disparities reach; rows above that the pass
/// has replaced are still in memory, or, in a program that continues, carried again.
///
/// Refers to the light field. Takes no result early. Throws InvalidInput as `prepare_stereo`,
/// Cancelled.
[[nodiscard]] BlockwiseRun planes_in_blocks(const LightField& light_field,
                                            const PlaneParameters& parameters, ViewSelection views,
                                            const Progress& progress);

}  // namespace episcope
