// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"

namespace episcope {

/// Weights of the total variation, `[y][x]` in (0, 1]: g = exp(−β·|∇I|), small where the view has
/// an edge, so that disparity may jump there. |∇I| is the norm of the forward differences over all
/// channels, samples in [0, 1]; one channel counts as three equal ones (channel_weight.h). β = 0
/// gives 1 everywhere.
///
/// Noise looks like edges: noise of variance σ² in each of C channels adds 4Cσ² to the mean of
/// |∇I|², which would make the total variation the cheaper the noisier the views are. With
/// `noise_variance` = σ² (local_noise.h) that much is taken off |∇I|², not below 0.
[[nodiscard]] Image<float> smoothness_weights(const LightField& light_field, ViewIndex view,
                                              double beta, double noise_variance = 0);

}  // namespace episcope
