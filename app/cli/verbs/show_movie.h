// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/arguments/arguments.h"
#include "app/cli/input/shown_map.h"
#include "app/session/picture/movie.h"

#include <functional>
#include <optional>

namespace episcope::cli {

/// The options of a movie.
struct MovieRequest {
  /// Empty: a parallax if the output is named like a movie.
  std::optional<render::MovieKind> kind;
  std::optional<Interval> focus;  ///< Empty = the disparities known of the light field.
  render::MovieChoice choice;     ///< The rest.
};

void declare_movie_options(Arguments& parser, MovieRequest& request);

/// The movie of a map that was loaded, which outlives it. Throws InvalidInput if the views or
/// disparities that it needs are not known.
[[nodiscard]] Movie movie_of(const MovieRequest& request, const LoadedMap& loaded,
                             std::function<RgbaImage(const MapSource&)> draw);

}  // namespace episcope::cli
