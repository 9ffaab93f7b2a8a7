// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/denoise.h"
#include "engine/disparity/epi/epi_l.h"
#include "engine/disparity/epi/line_check.h"

namespace episcope {

/// Parameters of EPI_S.
struct EpiSParameters {
  DenoiseParameters denoising = {};
  LineCheck line_check = {};
  EpiLParameters tensor = {};
};

[[nodiscard]] Schema<EpiSParameters> epi_s_schema();

/// EPI_S: EPI_L, denoised view by view (engine/disparity/common/denoise.h) with its coherence as
/// confidence. The largest relative duality gap is reported in the notes.
///
/// Defaults: λ = 0.2, p = 6, β = 20. A larger λ and more trust in coherence lower the MSE further
/// but flatten slopes (tests/accuracy/tuning.md).
/// Reference: Wanner and Goldluecke 2013 [WG13]; Rudin, Osher, Fatemi 1992 [ROF92].
[[nodiscard]] Estimate estimate_epi_s(const LightField& light_field,
                                      const EpiSParameters& parameters, ViewSelection views,
                                      const Progress& progress);

[[nodiscard]] Estimator epi_s_estimator();

}  // namespace episcope
