// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"

#include <vector>

namespace episcope::render {

/// How the camera moves over the grid of views.
enum class CameraPath {
  Circle,  ///< Around the center, through the outermost views of its row and column.
  Swing,   ///< Along the row of the center, there and back; in a grid of one column, along the
           ///< column.
  Snake,   ///< Through all views, row by row, every other one from right to left, and back.
};

/// The views that the camera stands at, one after the other; the first follows the last. No view
/// follows itself, unless there is but one; none in an empty
/// grid. A circle in a grid of one row or column is a swing.
[[nodiscard]] std::vector<ViewIndex> camera_path(GridShape grid, CameraPath path);

/// A value for each of `count` pictures that goes from `from` to `to` and back, slowly at the ends.
[[nodiscard]] std::vector<double> there_and_back(double from, double to, int count);

/// Quantity that changes in a movie.
enum class MovieKind {
  Parallax,  ///< The view, along a path.
  Refocus,   ///< The focus plane, through a range and back.
  Flip,      ///< Two maps take turns.
};

/// Settings of a movie.
struct MovieChoice {
  MovieKind kind = MovieKind::Parallax;
  CameraPath path = CameraPath::Circle;  ///< Of a parallax.
  Interval focus_px{};                   ///< Disparities of a refocus.
  double seconds = 3;                    ///< All of it, once.
  int width_px = 0;                      ///< 0 = as many as the pictures have.
};

inline constexpr Interval kMovieSeconds{0.1, 600};
inline constexpr int kWidestMovie_px = 16384;

}  // namespace episcope::render
