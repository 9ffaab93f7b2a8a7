// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/scene.h"

#include <string>
#include <vector>

namespace episcope::io {

/// Puts maps and labels of all views, whose center is right, into the order of the views: their
/// rows and columns of views may be exchanged or reversed. Looks at three views off the center and
/// off the diagonal. Maps must agree with the map of the center view, which shows the same points
/// in other places. Edges of labels must lie on jumps of the true disparity, or without it on edges
/// of the views. Another order is taken if this is far better by it. Returns a warning about what
/// was changed. Views are in canonical order.
[[nodiscard]] std::vector<std::string> put_truth_views_in_order(const LightField::Samples& samples,
                                                                GroundTruth& truth);

}  // namespace episcope::io
