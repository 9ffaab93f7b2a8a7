// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/epi_l.h"
#include "engine/disparity/global_labeling.h"

namespace episcope {

/// Parameters of EPI_G: those of EPI_L, and of the labeling.
struct EpiGParameters : EpiLParameters, GlobalLabelingParameters {
  EpiGParameters() {
    smoothness = 2;
    edge_strength = 10;
    settling = 3;
  }
  int labels = 64;
  double truncation = 0.3;
  double weight_power = 2;
};

[[nodiscard]] Schema<EpiGParameters> epi_g_schema();

/// EPI_G: a globally optimal labeling of the centre view on what its horizontal and vertical EPIs
/// say (EPI_L before merging): ρ(x, l) = r_h^p min(|l − d_h|, κ) + r_v^p min(|l − d_v|, κ), labels
/// equidistant over the range (label_globally). Between labels, a pixel goes to the mean of those
/// of d_h and d_v, weighted by r^p, that lie within one label of the solution.
/// Confidence is the larger coherence.
///
/// The data term of [WG12] was not recovered; truncating each direction by itself lets one outlier,
/// or both, be overruled, where min(r_h |l − d_h|, r_v |l − d_v|) must follow one of them.
/// Reference: Wanner and Goldluecke 2012 [WG12], as EPI_G in the paper.
[[nodiscard]] Estimate estimate_epi_g(const LightField& light_field,
                                      const EpiGParameters& parameters, const Progress& progress);

[[nodiscard]] Estimator epi_g_estimator();

}  // namespace episcope
