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

/// Strokes, and evidence for where their labels continue; borrowed.
struct StrokeKnowledge {
  const Scribbles& scribbles;
  const std::vector<std::int32_t>& ids;          ///< Of the labels painted, ascending.
  double nearness = 0;                           ///< LabelerParameters::nearness.
  const DisparityField* disparity = nullptr;     ///< Null = strokes stay in their views.
  const ViewStack<float>* confidence = nullptr;  ///< Of the disparity; null = it is right.
  bool judges_disparity = false;  ///< Whether disparity is evidence for labels; needs `disparity`.
};

/// Weights the forest's votes for the pixels of a view: by how well their disparity fits the
/// surface of each label, and by how near its strokes are (labeler.h says why). `features` of the
/// view. Throws Cancelled.
[[nodiscard]] ProbabilityMap predict_from_strokes(const StrokeKnowledge& known, ViewIndex view,
                                                  VolumeView<const float> features,
                                                  const PixelVotes& votes,
                                                  const Progress& progress);

/// How far the surface of each label holds away from its strokes, `[label]` in (0, 1]. Where the
/// forest gives a label at least kSureShare of its votes, disparity is not needed. If it fits other
/// labels better there, the estimate is wrong or the label is no plane, so its misfits should count
/// less. The support is the mean of exp(−(misfit − least misfit of all labels)) over those pixels,
/// weighted by trust, plus kPrior pixels that fit, so that labels without such pixels are believed.
///
/// Uses every eighth row. `trust` of the disparity `[y][x]` in [0, 1], empty = 1. An addition to
/// [WSG13]; tests/accuracy/tuning.md has the gain. Throws Cancelled.
[[nodiscard]] std::vector<float> surface_support(const PixelVotes& votes,
                                                 const LabelSurfaces& surfaces,
                                                 ImageView<const float> trust,
                                                 const Progress& progress);

/// Finds gaps of thin objects that the estimate has filled, `[y][x]`: an index of the label that
/// the image shows there plus one, 0 = none. Estimates extend the disparity of bars, stalks and
/// lattices into the gaps between them, where it contradicts the forest.
///
/// A pixel is in a gap if all of this holds:
/// - The forest prefers another label than the one whose surface its disparity fits best, and the
///   surface of the preferred label lies behind that disparity.
/// - Within kReach_px there is a thin part of the fitting label: kFewestPixels connected pixels or
///   more, in no square of kThin_px of that label, for which forest and disparity agree.
/// - More than half of the fitting label is thin; speckles of a doubtful forest are thin too.
/// - At most kMostThin of the preferred label is thin, because it continues beside the gaps.
///
/// An addition to [WSG13]; tests/accuracy/tuning.md has the gain. Throws Cancelled.
[[nodiscard]] Image<std::int32_t> labels_in_thin_gaps(const PixelVotes& votes,
                                                      const LabelSurfaces& surfaces,
                                                      const Progress& progress);

}  // namespace episcope
