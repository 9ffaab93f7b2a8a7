// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/document/scribble_layer.h"
#include "engine/core/light_field/disparity_field.h"
#include "engine/core/parallel/progress.h"

namespace episcope {

struct PropagationOptions {
  /// Two views see the same point if their disparities there differ by so much at most, in px.
  double tolerance_px = 0.25;
};

/// Carries scribbles to all other views along the rays of `field`, for display and training: a
/// layer of its own, bare wherever `painted` has a label. A pixel q of view t with disparity d
/// belongs to the pixel q + d·(t − s) of view s, to the nearest; it takes the label there if the
/// disparity of s there is d within the tolerance, so that what is hidden in either view is
/// skipped. Of several painted views the one nearest in the grid decides. The disparity of a view
/// that `field` does not cover is that of the nearest view that it does, warped through a z-buffer;
/// cracks of one pixel that slanted surfaces open are closed. Runs in parallel over views; linear
/// in views × painted views. Throws InvalidInput if the sizes of views differ or `field` lies
/// outside the grid; Cancelled.
[[nodiscard]] ScribbleLayer propagate(const ScribbleLayer& painted, const DisparityField& field,
                                      const PropagationOptions& options, const Progress& progress);

}  // namespace episcope
