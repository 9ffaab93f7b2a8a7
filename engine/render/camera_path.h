// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"

#include <string_view>
#include <vector>

namespace episcope::render {

/// How the camera moves over the grid of views.
enum class CameraPath {
  Circle,  ///< Around the centre, through the outermost views of its row and column.
  Swing,   ///< Along the row of the centre, there and back; in a grid of one column along that.
  Snake,   ///< Through all views, row by row, every other one from right to left, and back.
};

/// The views that the camera stands at, one after the other; the first follows the last. No view
/// follows itself, unless there is but one; none in an empty
/// grid. A circle in a grid of one row or column is a swing.
[[nodiscard]] std::vector<ViewIndex> camera_path(GridShape grid, CameraPath path);

/// A value for each of `count` pictures that goes from `from` to `to` and back, slowly at the ends.
[[nodiscard]] std::vector<double> there_and_back(double from, double to, int count);

}  // namespace episcope::render
