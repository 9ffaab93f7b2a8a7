// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"

#include <vector>

namespace episcope {

enum class PlayPath { Circle, Snake };

/// Views in the order in which they are played, as a closed loop of neighbours: the largest circle
/// around the centre, or the whole grid row by row, every other row backwards, and back again.
/// Empty for an empty grid.
[[nodiscard]] std::vector<ViewIndex> play_path(GridShape grid, PlayPath path);

}  // namespace episcope
