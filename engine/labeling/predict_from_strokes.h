// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/core/volume.h"
#include "engine/labeling/forest.h"
#include "engine/labeling/label_probabilities.h"
#include "engine/labeling/label_surfaces.h"

#include <cstdint>
#include <vector>

namespace episcope {

/// Strokes, and what is known about where their labels go on; borrowed.
struct StrokeKnowledge {
  const Scribbles& scribbles;
  const std::vector<std::int32_t>& ids;          ///< Of the labels painted, ascending.
  double nearness = 0;                           ///< LabelerParameters::nearness.
  const DisparityField* disparity = nullptr;     ///< Null = strokes stay in their views.
  const ViewStack<float>* confidence = nullptr;  ///< Of the disparity; null = it is right.
  bool judges_disparity = false;  ///< Whether disparity speaks for labels; it needs one then.
};

/// The votes of the forest for the pixels of a view, weighted by how well their disparity fits the
/// surfaces of the labels and by how near the strokes of each label are (labeler.h says why).
/// `features` of the view. Throws Cancelled.
[[nodiscard]] ProbabilityMap predict_from_strokes(const StrokeKnowledge& known, ViewIndex view,
                                                  VolumeView<const float> features,
                                                  const PixelVotes& votes,
                                                  const Progress& progress);

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
