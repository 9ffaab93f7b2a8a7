// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"

namespace episcope {

/// Place where a line of one image meets another of equal size: pixel (y, x) with slope s at
/// x + step·s in its row or, vertical, at y + step·s in its column.
struct LineStep {
  bool vertical = false;
  float step = 1;
};

/// ψ(a) = μ₊·max(a, 0) + μ₋·max(−a, 0), smoothed where it is steep (Moreau envelope):
/// ψ'(a) = clamp(a·μ₋/ε, −μ₋, μ₊). `rise` μ₊ ≤ `fall` μ₋, `softness` ε > 0.
struct OrderingPenalty {
  float rise = 0.01F;
  float fall = 0.1F;
  float softness = 0.05F;
};

/// D: out = to(x + step·slope(x)) − from(x), linear between pixels; NaN where the line leaves the
/// image. All images have one channel and one size. `slopes` must be finite.
void line_differences(ImageView<const float> slopes, ImageView<const float> from,
                      ImageView<const float> to, LineStep step, ImageView<float> out);

/// The quadratic majorizer of Σ ψ(Du) in one image while the others stay fixed: at most const −
/// force·δ + ½ curvature·δ² for a change δ, pixel by pixel, with equality at δ = 0.
struct OrderingPull {
  ImageView<float> curvature;
  ImageView<float> force;
};

/// Adds the pull on `from`, whose pixels begin the lines.
void add_pull_on_from(ImageView<const float> slopes, ImageView<const float> from,
                      ImageView<const float> to, LineStep step, const OrderingPenalty& penalty,
                      const OrderingPull& pull);

/// Adds the pull on `to`, where they end. Two taps share a line's curvature in the ratio of their
/// weights c: (Σ c δ)² ≤ Σ c δ².
void add_pull_on_to(ImageView<const float> slopes, ImageView<const float> from,
                    ImageView<const float> to, LineStep step, const OrderingPenalty& penalty,
                    const OrderingPull& pull);

}  // namespace episcope
