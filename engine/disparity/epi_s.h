// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/epi_l.h"

namespace episcope {

/// Parameters of EPI_S: those of EPI_L, and of the denoising.
struct EpiSParameters : EpiLParameters {
  double lambda = 0.1;
  double weight_power = 2;
  double edge_strength = 30;
  int max_iterations = 30;
  double gap = 1e-4;
};

[[nodiscard]] Schema<EpiSParameters> epi_s_schema();

/// EPI_S: EPI_L, denoised view by view: min Σ g |∇u| + 1/(2λ) Σ w (u − f)², with f the estimate of
/// EPI_L, w = max(r^p, 0.01) from its coherence r, and g = exp(−β |∇I|) from the view (TvL2Solver).
///
/// The paper has w = g = 1 ("just performs a TV-L2 denoising"); the weights are ours, measured
/// against truth: they keep jumps at image edges and let doubtful pixels follow their neighbours.
/// p = 0 and β = 0 give the plain method. The largest relative duality gap is in the notes.
/// Reference: Wanner and Goldluecke 2013 [WG13]; Rudin, Osher, Fatemi 1992 [ROF92].
[[nodiscard]] Estimate estimate_epi_s(const LightField& light_field,
                                      const EpiSParameters& parameters, ViewSelection views,
                                      const Progress& progress);

[[nodiscard]] Estimator epi_s_estimator();

}  // namespace episcope
