// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/image.h"
#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"

namespace episcope {

/// How edges of image and disparity are distinguished from noise.
struct EdgeParameters {
  double image = 25;     ///< β: larger values respond to weaker image edges; ≥ 0.
  double disparity = 4;  ///< γ, per px of jump: likewise for disparity; ≥ 0.
  /// What an image edge counts where no jump of disparity is near and disparity is known: most of
  /// them are texture. In [0, 1].
  double texture = 0.6;
};

/// The probability of an edge at every pixel of a view, `[y][x]` in [0, 1], as EDGE_WEIGHTS of the
/// archive: 1 − exp(−β·m·|∇I| − γ·|∇d|), forward differences, samples in [0, 1], |∇I| over all
/// channels; m grows from `texture` to 1 with the largest jump within 3 px, because estimated jumps
/// lie beside the edges that they belong to. Views that `disparity` (which may be empty) does not
/// cover, and pixels where it is invalid, use the image alone. Throws InvalidInput on a wrong size,
/// Cancelled.
///
/// The archive does not say how its own weights were computed; this is the usual exponential of the
/// gradient, with disparity added.
[[nodiscard]] Image<float> edge_probability(const LightField& light_field, ViewIndex view,
                                            const DisparityField& disparity,
                                            const EdgeParameters& parameters);
/// Of all views, or of those of a rectangle, `[v][u][y][x]`. With the confidence of the disparity,
/// m tends to 1 and jumps to 0 where disparity is not trusted (`disparity_trust`).
[[nodiscard]] ViewStack<float> edge_probabilities(const LightField& light_field,
                                                  const DisparityField& disparity,
                                                  const EdgeParameters& parameters,
                                                  const Progress& progress);
[[nodiscard]] ViewStack<float> edge_probabilities(const LightField& light_field,
                                                  ViewRectangle views,
                                                  const DisparityField& disparity,
                                                  const EdgeParameters& parameters,
                                                  const Progress& progress,
                                                  const ViewStack<float>* confidence = nullptr);

/// How far the disparity of each pixel is trusted as evidence for labels, `[y][x]` in [0, 1]:
/// min(c/(0.43·s), 1)², c the confidence of the estimate around the pixel (Gaussian, σ = 2 px) and
/// s that which a tenth of the pixels exceed, since methods scale confidence differently; 0 if s is
/// 0. Where an estimate had nothing to hold on to, it is what its neighbours suggested, and says of
/// which label they are. `confidence` `[y][x]` in [0, 1].
[[nodiscard]] Image<float> disparity_trust(ImageView<const float> confidence);

}  // namespace episcope
