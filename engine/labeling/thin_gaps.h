// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/parallel/progress.h"
#include "engine/labeling/features/label_surfaces.h"
#include "engine/labeling/forest/pixel_votes.h"

#include <cstdint>

namespace episcope {

/// Where the gaps of thin things were filled by the estimate: an index of the label that the image
/// shows there plus one, `[y][x]`, 0 = nowhere. Estimates carry the disparity of bars, stalks and
/// lattices into what is seen between them, where it contradicts what the forest sees.
///
/// A pixel lies in such a gap if the forest votes most for another label than the one whose surface
/// its disparity fits best, the surface of the voted label lies behind that disparity, and within
/// kReach_px of it there is a thin thing of the fitting label: kFewestPixels connected pixels or
/// more for which the forest votes and whose disparity agrees, in no square of kThin_px of that
/// label alone. More than half of the label's pixels must be thin, because speckles of a forest in
/// doubt are thin as well; of the voted label at most kMostThin of them, because what shows in gaps
/// goes on beside them.
///
/// An own addition; what it gains is in tests/accuracy/tuning.md. Throws Cancelled.
[[nodiscard]] Image<std::int32_t> labels_in_thin_gaps(const PixelVotes& votes,
                                                      const LabelSurfaces& surfaces,
                                                      const Progress& progress);

}  // namespace episcope
