// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_rectangle.h"
#include "engine/labeling/rays/regularizer.h"

namespace episcope {

/// Throws InvalidInput unless the views are in the grid, and one at least.
void require_views(ViewRectangle views, GridShape grid);

/// Throws InvalidInput if the regulariser joins views and there is no disparity to join them by.
void require_disparity(Regularizer regularizer, bool has_disparity);

/// The view and those beside it in its row; in a grid of one column, above and below.
[[nodiscard]] ViewRectangle neighbours(ViewIndex view, GridShape grid);

}  // namespace episcope
