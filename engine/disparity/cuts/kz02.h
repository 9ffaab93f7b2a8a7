// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/estimator.h"
#include "engine/disparity/common/profile.h"
#include "engine/disparity/common/sub_label.h"
#include "engine/disparity/cuts/interactions.h"

namespace episcope {

/// Parameters of KZ02.
struct Kz02Parameters {
  ProfileChoice profile = {};
  int labels = 64;
  int distance = 4;
  Matching matching = {};
  double smoothness = 0.02;  ///< λ, in K.
  int truncation = 3;
  int cycles = 4;
  Refinement refinement = Refinement::Parabola;
  IntervalOrAuto range;
  ViewOrAuto view;
};

[[nodiscard]] Schema<Kz02Parameters> kz02_schema();

/// KZ02: multi-camera scene reconstruction via graph cuts. Labels of one view and of up to four
/// side views, left, right, above and below it, are found together: pixels of two views that have
/// the label at which both see the same point gain by it the more they look alike, neighbours of a
/// view should have similar labels, and no pixel may look through what another view sees
/// (MultiCameraEnergy). The energy is lowered by α-expansions (LabelExpansion) from the farthest
/// label on until no label lowers it further, or for `cycles` rounds; the order of labels is coarse
/// to fine. Views interact with the estimated one, not among each other. Only the labels of the
/// estimated view are returned.
///
/// Confidence: which share of the greatest possible gain a pixel has; 0 where no side view sees it.
/// The notes hold K, the fall of the energy and whether it ended at a minimum.
///
/// The profile `paper` is the method as published, with K and λ = K/5 by the published heuristic.
/// The default departs from it: views are compared between pixels, because labels of a dense light
/// field are finer than pixels; λ is a fraction of that for the same reason, since a slope jumps by
/// many labels; and each pixel moves between labels by a parabola through the matching costs over
/// all views (st_av_l). From the second cycle on, both expand a label only near what has changed
/// since its last expansion (RecentChanges). Evidence: tests/accuracy/tuning.md.
///
/// Takes about 1.6 kB for each pixel of the view, most of it for the cut, and runs on one thread. A
/// cut of 768×768 px takes seconds; it polls the progress all the while. Ends at
/// `progress.finish_requested()` with the labels so far. Throws InvalidInput (no such view, a
/// single view), Cancelled. Reference: Kolmogorov and Zabih 2002 [KZ02]; heuristics of the authors'
/// program [KMT14].
[[nodiscard]] Estimate estimate_kz02(const LightField& light_field,
                                     const Kz02Parameters& parameters, const Progress& progress);

[[nodiscard]] Estimator kz02_estimator();

}  // namespace episcope
