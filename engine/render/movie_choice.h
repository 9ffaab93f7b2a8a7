// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"
#include "engine/render/camera_path.h"

namespace episcope::render {

/// What changes in a movie.
enum class MovieKind {
  Parallax,  ///< The view, along a path.
  Refocus,   ///< The focus plane, through a range and back.
  Flip,      ///< Two maps take turns.
};

/// How a movie is made.
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
