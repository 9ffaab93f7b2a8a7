// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/verbs/show_movie.h"

#include "app/session/scene/scene_range.h"
#include "engine/core/error.h"

#include <string>
#include <utility>

namespace episcope::cli {
namespace {

using render::CameraPath;
using render::MovieChoice;
using render::MovieKind;
using render::Quantity;

/// The other result of a flip.
std::optional<MapSource> other_map(const LoadedMap& loaded) {
  if (!loaded.source.other) return std::nullopt;
  MapSource other = loaded.source;
  other.quantity = Quantity::Disparity;
  other.estimate = other.other;
  const std::string reason = reason_against(other);
  if (!reason.empty()) throw InvalidInput(reason);
  return other;
}

Interval focus_range(const MovieRequest& request, const LoadedMap& loaded) {
  if (request.focus) return *request.focus;
  const Interval known = loaded.scene ? known_disparity_range(*loaded.scene) : Interval{};
  if (known.length() > 0) return known;
  throw InvalidInput(
      "the disparities of this light field are not known; say with --focus-range A,B from where to "
      "where the focus moves");
}

}  // namespace

void declare_movie_options(Arguments& parser, MovieRequest& request) {
  parser.heading("Movies");
  parser.option("--movie", request.kind,
                choice_of<MovieKind>({{MovieKind::Parallax, "parallax"},
                                      {MovieKind::Refocus, "refocus"},
                                      {MovieKind::Flip, "flip"}}),
                "What changes: the view, the focus plane, or a RESULT and that of --minus in "
                "turns; by default the view if OUT is a movie");
  parser.option("--path", request.choice.path,
                choice_of<CameraPath>({{CameraPath::Circle, "circle"},
                                       {CameraPath::Swing, "swing"},
                                       {CameraPath::Snake, "snake"}}),
                "How a parallax moves: around the centre, along the row of the centre, or through "
                "all views (default circle)");
  parser.option("--seconds", request.choice.seconds,
                real_value("S", render::kMovieSeconds.min, render::kMovieSeconds.max),
                "How long the movie lasts (default 3)");
  parser.option("--width", request.choice.width_px,
                integer_value("PIXELS", 0, render::kWidestMovie_px),
                "Width of the movie; its height follows (default 0: as the picture)");
  parser.option("--focus-range", request.focus, interval_value(),
                "Where the focus moves; by default over the disparities that are known");
}

Movie movie_of(const MovieRequest& request, const LoadedMap& loaded,
               std::function<RgbaImage(const MapSource&)> draw) {
  MovieChoice choice = request.choice;
  choice.kind = request.kind.value_or(MovieKind::Parallax);
  MovieSubject subject{loaded.source, std::nullopt, loaded.scene ? &*loaded.scene : nullptr,
                       std::move(draw)};
  if (choice.kind == MovieKind::Flip) {
    subject.other = other_map(loaded);
    subject.source.quantity = Quantity::Disparity;
  }
  if (choice.kind == MovieKind::Refocus && loaded.source.quantity == Quantity::View) {
    choice.focus_px = focus_range(request, loaded);
  }
  return make_movie(choice, subject);
}

}  // namespace episcope::cli
