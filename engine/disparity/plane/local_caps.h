// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

namespace episcope {

/// What the cap ε of a pixel is made of.
struct LocalCapOptions {
  float offset = 0.03F;  ///< Error of disparity that is still to cost its due, px.
  float noise_share = 2;
  /// In three channels; in one, 1/√3 of them.
  float lowest = 0.01F;
  float highest = 0.015F;
};

/// ε at each pixel of a view, `[y][x]`: what a disparity that is off by `offset` px costs there,
/// the mean over all views of |I(x + offset·v) − I(x)| to first order, within [lowest, highest],
/// and `noise_share` standard deviations of the noise. Samples in [0, 1], Euclidean norm over the
/// channels. `variance`: of the noise, `[y][x]`. Throws Cancelled.
[[nodiscard]] Image<float> local_caps(const LightField& light_field, ViewIndex view,
                                      const Image<float>& variance, const LocalCapOptions& options,
                                      const Progress& progress);

}  // namespace episcope
