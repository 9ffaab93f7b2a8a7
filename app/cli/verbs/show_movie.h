// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/arguments/arguments.h"
#include "app/cli/input/shown_map.h"
#include "app/session/picture/movie.h"

#include <functional>
#include <optional>
#include <string>

namespace episcope::cli {

/// What changes in a movie that `show` writes.
enum class MovieKind { Parallax, Refocus, Flip };

/// The options of a movie.
struct MovieRequest {
  std::optional<MovieKind> kind;  ///< Empty: a parallax if the output is named like a movie.
  render::CameraPath path = render::CameraPath::Circle;
  double seconds = 3;
  int width_px = 0;               ///< 0 = as many as the picture has.
  std::optional<Interval> focus;  ///< Empty = the disparities known of the light field.
};

void declare_movie_options(Arguments& parser, MovieRequest& request);

/// The movie of a map that was loaded; `picture` draws it as it stands in a source. Throws
/// InvalidInput if the views or disparities that it needs are not known.
[[nodiscard]] Movie make_movie(const MovieRequest& request, const LoadedMap& loaded,
                               const std::function<RgbaImage(const MapSource&)>& picture);

}  // namespace episcope::cli
