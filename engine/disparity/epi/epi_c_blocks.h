// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/blockwise.h"
#include "engine/disparity/epi/epi_c.h"

namespace episcope {

/// EPI_C in blocks: orientations in bands of rows; then views of one row of the grid after the
/// other, whose lines are checked and which are denoised by themselves; then rays that other views
/// see through are replaced, and every half of a sweep is one pass, which needs the views above and
/// below. What was observed and what was denoised before the first sweep are kept. The centre view
/// alone needs all others and is one block.
///
/// Refers to the light field. Takes no result early. Throws as `estimate_epi_c`.
[[nodiscard]] BlockwiseRun epi_c_in_blocks(const LightField& light_field,
                                           const EpiCParameters& parameters, ViewSelection views,
                                           const Progress& progress);

}  // namespace episcope
