// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/core/schema.h"

namespace episcope {

/// Whether islands are filled.
struct IslandParameters {
  bool islands = true;
};
[[nodiscard]] Schema<IslandParameters> island_schema();
/// The value that keeps islands, as the paper.
[[nodiscard]] ParameterSet plain_islands();

/// Replaces what is too small to be a surface: one pixel, or two neighbors, more than 0.5 px of
/// disparity nearer than all the pixels around them, or farther than all, diagonal neighbors
/// included, take the median of those. A value between its neighbors is the blur of a silhouette
/// and stays. Values that are not finite neither count nor change.
///
/// Why: a dot or a crossing of joints that is smaller than a pixel has another color in every view
/// and matches anywhere by chance; edges on all its sides keep smoothing from joining it to its
/// neighbors (tests/accuracy/tuning.md). Throws Cancelled.
void fill_islands(const Progress& progress, ImageView<float> disparity);
/// Fills islands if the parameters ask for it.
void fill_islands(const IslandParameters& parameters, const Progress& progress,
                  ImageView<float> disparity);

}  // namespace episcope
