// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/named.h"
#include "engine/labeling/rays/ray_labeling.h"

namespace episcope {

/// How labels are made consistent. To add a method: an enumerator, a pair of files like
/// view_smoothing.h and a row of the table in regularizer.cpp.
enum class Regularizer {
  None,      ///< Not at all: the most probable label of each ray (no_smoothing.h).
  View,      ///< Within each view, whatever the others say (view_smoothing.h).
  Rayspace,  ///< Within each view and along the rays through all of them (ray_smoothing.h).
  Wsg13,     ///< All views as one problem, coupled along the lines of EPIs (line_smoothing.h).
};
[[nodiscard]] Names<Regularizer> names_of(Regularizer);

/// A row of the table of regularisers.
struct RegularizerInfo {
  Named<Regularizer> choice;
  /// Whether the labels of one view depend on the others: needs the disparity of all of them, and
  /// for a single view the probabilities of its neighbours.
  bool joins_views = false;
  /// Labels of all views that have probabilities, and of one of them.
  RayLabeling (*label_all)(const RayLabelingInput&, const RayLabelingParameters&,
                           const Progress&) = nullptr;
  RayLabeling (*label_one)(const RayLabelingInput&, ViewIndex, const RayLabelingParameters&,
                           const Progress&) = nullptr;
};

[[nodiscard]] const RegularizerInfo& info_of(Regularizer regularizer);

/// Labels of all views that have probabilities. Throws InvalidInput if parts of the input are
/// missing or do not fit, Cancelled. Ends each solver after its next iteration at
/// `progress.finish_requested()`.
[[nodiscard]] RayLabeling label_rays(const RayLabelingInput& input, Regularizer regularizer,
                                     const RayLabelingParameters& parameters,
                                     const Progress& progress);

/// Labels of one view, from its probabilities and those of other views as far as available: for an
/// answer while the user paints. Throws likewise.
[[nodiscard]] RayLabeling label_view(const RayLabelingInput& input, ViewIndex view,
                                     Regularizer regularizer,
                                     const RayLabelingParameters& parameters,
                                     const Progress& progress);

}  // namespace episcope
