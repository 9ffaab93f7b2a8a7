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
  /// Weight of an image edge, in [0, 1], where disparity is known and does not jump: most such
  /// edges are texture.
  double texture = 0.4;
};

/// The probability of an edge at every pixel of a view, `[y][x]` in [0, 1], as EDGE_WEIGHTS of the
/// archive: 1 − exp(−β·m·|∇I| − γ·|∇d|), forward differences, samples in [0, 1], |∇I| over all
/// channels; m grows from `texture` to 1 with the largest jump within 2 px, because estimated jumps
/// lie beside the edges that they belong to. Views that `disparity` (which may be empty) does not
/// cover, and pixels where it is invalid, use the image alone. Throws InvalidInput on a wrong size,
/// Cancelled.
///
/// The archive does not say how its own weights were computed; this is the usual exponential of the
/// gradient, with disparity added.
[[nodiscard]] Image<float> edge_probability(const LightField& light_field, ViewIndex view,
                                            const DisparityField& disparity,
                                            const EdgeParameters& parameters);
/// Edge probabilities of all views or of a rectangle of views, `[v][u][y][x]`. With the confidence
/// of the disparity, m tends to 1 and jumps tend to 0 where disparity is not trusted
/// (`disparity_trust`).
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
/// min(c/(0.43·s), 1)². c is the confidence around the pixel (Gaussian, σ = 2 px); s is exceeded by
/// a tenth of the pixels, since methods scale confidence differently; 0 if s is 0. An estimate
/// without evidence follows its neighbors, and tells about their labels only. `confidence` `[y][x]`
/// in [0, 1].
[[nodiscard]] Image<float> disparity_trust(ImageView<const float> confidence);

}  // namespace episcope
