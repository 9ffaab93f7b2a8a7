// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/io/models/order/line_matches.h"
#include "engine/io/models/order/view_order.h"

#include <string>

namespace episcope::io {

/// Directions of the view axes according to occlusion.
struct SignFinding {
  ViewFlip flip;            ///< The order that was asked about, or what occlusion makes of it.
  bool is_decided = false;  ///< Whether near and far are told apart.
  std::string evidence;     ///< With numbers: what was counted, and for which order.
};

/// Determines which axes are reversed from occlusion, at several resolutions until it is clear.
/// `flip` is the order that is known or expected so far. With `are_axes_related` it is certain
/// whether the axes agree, and they are judged together; else each axis by itself. Throws
/// Cancelled.
[[nodiscard]] SignFinding check_sign(const CoarseMotion& coarse, ViewFlip flip,
                                     bool are_axes_related, const Progress& progress);

}  // namespace episcope::io
