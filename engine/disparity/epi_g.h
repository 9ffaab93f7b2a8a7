// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/epi_l.h"
#include "engine/disparity/global_labeling.h"
#include "engine/disparity/line_check.h"

namespace episcope {

/// How the costs of both directions become one: their sum, or the lesser.
enum class DirectionCosts { Sum, Least };
[[nodiscard]] Names<DirectionCosts> names_of(DirectionCosts);

struct EpiGParameters {
  GlobalLabelingParameters labeling{.smoothness = 1.6, .edge_strength = 20, .settling = 3};
  int labels = 64;
  DirectionCosts direction_costs = DirectionCosts::Sum;
  double truncation = 0.5;
  double weight_power = 1;
  LineCheck line_check = {};
  EpiLParameters tensor{.cross_scale = kCrossScaleOfDenoised};
};

/// EPI_G: a globally optimal labeling of the center view from its horizontal and vertical EPIs
/// (EPI_L before merging): ρ(x, l) = r_h^p min(|l − d_h|, κ) + r_v^p min(|l − d_v|, κ), labels
/// equidistant over the range (label_globally). Each direction's estimate is checked as in EPI_S
/// (check_lines). λ is in units of the mean of r^p
/// over both directions, so that weak texture and noise are not smoothed away. Between labels, a
/// pixel moves to the mean, weighted by r^p, of d_h and d_v, as long as they lie within one label
/// of the solution. Confidence is the larger coherence.
///
/// The profile `paper` has labels over the range, no edge weights, no settling and no check of
/// lines, EPI_L as published, and as data term min(r_h |l − d_h|, r_v |l − d_v|), which is how
/// [WG12] is remembered; λ is not given: 0.75. TV is LiftedProblem's, isotropic to 8 %.
///
/// Truncating each direction separately lets one or both
/// be overruled as outliers, whereas min(r_h |l − d_h|, r_v |l − d_v|) must follow one of them.
/// Evidence: tests/accuracy/tuning.md.
/// Reference: Wanner and Goldluecke 2012 [WG12], as EPI_G in the paper.
[[nodiscard]] Estimate estimate_epi_g(const LightField& light_field,
                                      const EpiGParameters& parameters, const Progress& progress,
                                      Device device = Device::Cpu);

[[nodiscard]] Estimator epi_g_estimator();

}  // namespace episcope
