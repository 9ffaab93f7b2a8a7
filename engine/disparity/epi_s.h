// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/denoise.h"
#include "engine/disparity/epi_l.h"
#include "engine/disparity/line_check.h"

namespace episcope {

struct EpiSParameters {
  DenoiseParameters denoising{.lambda = 0.1, .weight_power = 4, .edge_strength = 15};
  LineCheck line_check = {};
  EpiLParameters tensor{.cross_scale = kCrossScaleOfDenoised};
};

/// EPI_S: EPI_L, denoised view by view (engine/disparity/denoise.h) with its coherence as
/// confidence. Before, unless `choose_sides` is off, pixels near a jump take the side whose lines
/// they fit (choose_sides), and unless `check_lines` is off, confidence is lowered where the views
/// contradict the estimate (reduce_confidence). The largest relative duality gap is reported in the
/// notes.
///
/// Defaults: λ = 0.1, p = 4, β = 15. A larger λ and more trust in coherence lower the MSE under
/// noise but flatten slopes and lose thin bars (tests/accuracy/tuning.md).
///
/// The profile `paper` denoises EPI_L as published without weights, w = g = 1, and without either
/// check. The publications do not give λ: 0.2.
/// Reference: Wanner and Goldluecke 2013 [WG13]; Rudin, Osher, Fatemi 1992 [ROF92].
[[nodiscard]] Estimate estimate_epi_s(const LightField& light_field,
                                      const EpiSParameters& parameters, ViewSelection views,
                                      const Progress& progress, Device device = Device::Cpu);

[[nodiscard]] Estimator epi_s_estimator();

}  // namespace episcope
