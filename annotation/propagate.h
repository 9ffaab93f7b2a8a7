// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/scribble_layer.h"
#include "engine/core/disparity_field.h"
#include "engine/core/progress.h"

namespace episcope {

struct PropagationOptions {
  /// Two views see the same point if their disparities there differ by at most this, in px.
  double tolerance_px = 0.25;
};

/// Propagates scribbles to all other views along the rays of `field`, for display and training: a
/// separate layer, empty wherever `painted` has a label. A pixel q of view t with disparity d
/// corresponds to the nearest pixel to q + d·(t − s) of view s; it takes the label there if the
/// disparity of s there equals d within the tolerance, so that points occluded in either view are
/// skipped. Of several painted views the nearest in the grid takes precedence. For a view that
/// `field` does not cover, the disparity of the nearest covered view is warped through a z-buffer;
/// cracks of one pixel, which open on slanted surfaces, are closed. Runs in parallel over views;
/// linear in views × painted views. Throws InvalidInput if the sizes of views differ or `field`
/// lies outside the grid; Cancelled.
[[nodiscard]] ScribbleLayer propagate(const ScribbleLayer& painted, const DisparityField& field,
                                      const PropagationOptions& options, const Progress& progress);

}  // namespace episcope
