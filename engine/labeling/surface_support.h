// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/parallel/progress.h"
#include "engine/labeling/features/label_surfaces.h"
#include "engine/labeling/forest/pixel_votes.h"

#include <vector>

namespace episcope {

/// How far the surface of each label holds away from its strokes, `[label]` in (0, 1]. Pixels that
/// the forest gives to a label with at least kSureShare of its votes do not need disparity to be
/// told apart; if theirs fits other labels better, the estimate is wrong there or the label is not
/// the plane of its strokes, and its misfits should count less. The support is the mean of
/// exp(−(misfit − least misfit of all labels)) over those pixels, weighted by their trust, with
/// kPrior pixels that fit; so labels without such pixels are believed.
///
/// Every eighth row is looked at.
/// `trust` of the disparity `[y][x]` in [0, 1], empty = 1. An own addition; what it gains is in
/// tests/accuracy/tuning.md. Throws Cancelled.
[[nodiscard]] std::vector<float> surface_support(const PixelVotes& votes,
                                                 const LabelSurfaces& surfaces,
                                                 ImageView<const float> trust,
                                                 const Progress& progress);

}  // namespace episcope
