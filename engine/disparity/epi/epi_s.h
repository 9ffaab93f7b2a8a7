// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/denoise.h"
#include "engine/disparity/epi/epi_l.h"

namespace episcope {

/// Parameters of EPI_S.
struct EpiSParameters {
  DenoiseParameters denoising = {};
  EpiLParameters tensor = {};
};

[[nodiscard]] Schema<EpiSParameters> epi_s_schema();

/// EPI_S: EPI_L, denoised view by view (engine/disparity/common/denoise.h) with its coherence as
/// the confidence. The largest relative duality gap is in the notes.
///
/// Defaults: λ = 0.2, p = 6, β = 20. Of the sets tried on the built-in scenes with and without
/// noise of 5/255 and on two rendered ones (centre view), more trust in coherence and a larger λ
/// lower the MSE further (λ = 0.4, p = 8: at thin bars to a quarter) but flatten slopes: on the
/// rendered still life BadPix(0.07) then rises from 8 to 14 %.
/// Reference: Wanner and Goldluecke 2013 [WG13]; Rudin, Osher, Fatemi 1992 [ROF92].
[[nodiscard]] Estimate estimate_epi_s(const LightField& light_field,
                                      const EpiSParameters& parameters, ViewSelection views,
                                      const Progress& progress);

[[nodiscard]] Estimator epi_s_estimator();

}  // namespace episcope
