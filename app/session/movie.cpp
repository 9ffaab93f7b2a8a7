// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/movie.h"

#include "engine/core/error.h"
#include "engine/io/formats/movie.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace episcope {
namespace {

using render::MovieChoice;
using render::MovieKind;
using render::Quantity;

constexpr double kRefocusRate = 12;  // Pictures per second.

GridShape grid_of(const MapSource& source) {
  if (source.light_field) return source.light_field->grid();
  const ViewStack<float>& maps = source.estimate->field.disparity;
  return {maps.first().v + maps.grid().v, maps.first().u + maps.grid().u};
}

bool has_map(const MovieSubject& subject, ViewIndex view) {
  MapSource source = subject.source;
  source.view = view;
  if (source.quantity == Quantity::View) return true;
  if (!reason_against(source).empty()) return false;
  if (!source.evaluation || view == subject.source.view) return true;
  return subject.scene && can_judge(*source.estimate, *subject.scene, view);
}

MapSource in_view(const MovieSubject& subject, ViewIndex view) {
  MapSource source = subject.source;
  if (source.evaluation && !(source.view == view)) {
    source.evaluation =
        std::make_shared<const Evaluation>(judge(*source.estimate, *subject.scene, {}, view));
  }
  source.view = view;
  return source;
}

Movie parallax(const MovieChoice& choice, const MovieSubject& subject) {
  std::vector<ViewIndex> views = render::camera_path(grid_of(subject.source), choice.path);
  std::erase_if(views, [&](ViewIndex view) { return !has_map(subject, view); });
  if (views.empty()) {
    throw InvalidInput(
        "none of the views along the path has such a picture; a movie needs a result of all views");
  }
  const auto count = static_cast<int>(views.size());
  return {count, count / choice.seconds, [views = std::move(views), subject](int i) {
            return subject.draw(in_view(subject, views[i]));
          }};
}

Movie refocused(const MovieChoice& choice, const MovieSubject& subject) {
  if (!subject.source.light_field || subject.source.quantity != Quantity::View) {
    throw InvalidInput("only the view of a light field can be refocused, not a map");
  }
  const int count = std::max(2, static_cast<int>(std::lround(choice.seconds * kRefocusRate)));
  std::vector<double> focus =
      render::there_and_back(choice.focus_px.min, choice.focus_px.max, count);
  return {count, count / choice.seconds, [focus = std::move(focus), subject](int i) {
            const MapSource& source = subject.source;
            const Image<float> samples =
                render::refocus(*source.light_field, source.view, focus[i]);
            return render::shade_samples(samples.view(), subject.tone);
          }};
}

Movie flipped(const MovieChoice& choice, const MovieSubject& subject) {
  if (!subject.other) throw InvalidInput("a flip needs two results; choose a second one");
  return {2, 2 / choice.seconds,
          [subject](int i) { return subject.draw(i == 0 ? subject.source : *subject.other); }};
}

}  // namespace

Movie make_movie(const MovieChoice& choice, const MovieSubject& subject) {
  switch (choice.kind) {
    case MovieKind::Parallax:
      return parallax(choice, subject);
    case MovieKind::Refocus:
      return refocused(choice, subject);
    case MovieKind::Flip:
      break;
  }
  return flipped(choice, subject);
}

void write_movie(const std::filesystem::path& path, const Movie& movie, int width_px,
                 const Progress& progress) {
  std::unique_ptr<io::MovieFile> file;
  for (int i = 0; i < movie.count; ++i) {
    progress.check();
    const RgbaImage picture = movie.picture(i);
    if (!file) {
      file = std::make_unique<io::MovieFile>(
          path, io::MovieShape{picture.height(), picture.width(), movie.rate, width_px});
    }
    file->add(picture.view());
    progress.report(static_cast<double>(i + 1) / movie.count);
  }
  if (file) file->commit();
}

}  // namespace episcope
