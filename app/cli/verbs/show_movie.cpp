// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/verbs/show_movie.h"

#include "app/session/scene/scene_range.h"
#include "engine/core/error.h"

#include <utility>

namespace episcope::cli {
namespace {

using render::CameraPath;
using render::Quantity;

/// The source in another view, judged there where it is an error.
MapSource in_view(const LoadedMap& loaded, ViewIndex view) {
  MapSource source = loaded.source;
  if (source.evaluation && !(source.view == view)) {
    source.evaluation =
        std::make_shared<const Evaluation>(judge(*source.estimate, *loaded.scene, {}, view));
  }
  source.view = view;
  return source;
}

bool has_picture(const LoadedMap& loaded, ViewIndex view) {
  MapSource source = loaded.source;
  source.view = view;
  if (!reason_against(source).empty()) return false;
  return !source.evaluation || can_judge(*source.estimate, *loaded.scene, view);
}

Movie parallax(const MovieRequest& request, const LoadedMap& loaded,
               const std::function<RgbaImage(const MapSource&)>& picture) {
  GridShape grid;
  if (loaded.source.light_field) {
    grid = loaded.source.light_field->grid();
  } else {
    const ViewStack<float>& maps = loaded.source.estimate->field.disparity;
    grid = {maps.first().v + maps.grid().v, maps.first().u + maps.grid().u};
  }
  return parallax_movie(
      grid, request.path, request.seconds,
      [&loaded](ViewIndex view) { return has_picture(loaded, view); },
      [&loaded, picture](ViewIndex view) { return picture(in_view(loaded, view)); });
}

Movie refocused(const MovieRequest& request, const LoadedMap& loaded) {
  if (!loaded.source.light_field || loaded.source.quantity != Quantity::View) {
    throw InvalidInput("only the view of a light field can be refocused; leave --what out");
  }
  const Interval range = request.focus.value_or(known_disparity_range(*loaded.scene));
  if (!(range.length() > 0)) {
    throw InvalidInput(
        "the disparities of this light field are not known; say with --focus-range A,B from where "
        "to where the focus moves");
  }
  return refocus_movie(loaded.source.light_field, loaded.source.view, range, request.seconds);
}

Movie flipped(const MovieRequest& request, const LoadedMap& loaded,
              const std::function<RgbaImage(const MapSource&)>& picture) {
  if (!loaded.source.estimate || !loaded.source.other) {
    throw InvalidInput("a flip shows two results in turns; name the second with --minus RESULT");
  }
  MapSource first = loaded.source, second = loaded.source;
  first.quantity = second.quantity = Quantity::Disparity;
  second.estimate = second.other;
  const std::string reason = reason_against(second);
  if (!reason.empty()) throw InvalidInput(reason);
  return flip_movie(picture(first), picture(second), request.seconds);
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
  parser.option("--path", request.path,
                choice_of<CameraPath>({{CameraPath::Circle, "circle"},
                                       {CameraPath::Swing, "swing"},
                                       {CameraPath::Snake, "snake"}}),
                "How a parallax moves: around the centre, along the row of the centre, or through "
                "all views (default circle)");
  parser.option("--seconds", request.seconds, real_value("S", 0.1, 600),
                "How long the movie lasts (default 3)");
  parser.option("--width", request.width_px, integer_value("PIXELS", 0, 16384),
                "Width of the movie; its height follows (default 0: as the picture)");
  parser.option("--focus-range", request.focus, interval_value(),
                "Where the focus moves; by default over the disparities that are known");
}

Movie make_movie(const MovieRequest& request, const LoadedMap& loaded,
                 const std::function<RgbaImage(const MapSource&)>& picture) {
  switch (request.kind.value_or(MovieKind::Parallax)) {
    case MovieKind::Parallax:
      return parallax(request, loaded, picture);
    case MovieKind::Refocus:
      return refocused(request, loaded);
    case MovieKind::Flip:
      break;
  }
  return flipped(request, loaded, picture);
}

}  // namespace episcope::cli
