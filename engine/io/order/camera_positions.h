// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/io/order/view_order.h"

#include <string>
#include <vector>

namespace episcope::io {

/// Reverses positions, row by row on the grid, along with their views.
void reverse_positions(std::vector<CameraPosition>& positions, GridShape grid, ViewFlip flip);

/// "camera right = smaller X, camera down = larger Y": how positions in canonical order change from
/// view to view. Empty if there are none, or if they do not change.
[[nodiscard]] std::string position_directions(const std::vector<CameraPosition>& positions,
                                              GridShape grid);

}  // namespace episcope::io
