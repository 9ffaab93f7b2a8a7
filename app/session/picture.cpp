// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/picture.h"

#include "engine/core/epi.h"
#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/io/formats/movie.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace episcope {

namespace {

constexpr int kAlpha = 3;

void check_line(const char* name, int line, int count) {
  if (line >= 0 && line < count) return;
  throw InvalidInput(std::string("there is no image ") + name + " " + std::to_string(line) +
                     "; they count from 0 to " + std::to_string(count - 1));
}

RgbaImage stretched(const RgbaImage& picture) {
  RgbaImage tall(picture.height() * kEpiRowHeight, picture.width(), picture.channels());
  const std::size_t row_size = static_cast<std::size_t>(picture.width()) * picture.channels();
  for (int y = 0; y < tall.height(); ++y) {
    std::copy_n(picture.row(y / kEpiRowHeight), row_size, tall.row(y));
  }
  return tall;
}

// Calls `change` with every pixel that is not judged; labels are all shown.
template <class Change>
RgbaImage shaded(const QuantityMap& map, const render::Shading& shading, const Change& change) {
  if (!map.labels.empty()) {
    return render::shade_labels(map.labels, map.label_infos, map.label_style);
  }
  RgbaImage picture = render::shade(map.map, map.valid, shading);
  if (map.inside.empty()) return picture;
  for (int y = 0; y < picture.height(); ++y) {
    const std::uint8_t* inside = map.inside.row(y);
    for (int x = 0; x < picture.width(); ++x) {
      if (inside[x] == 0) change(&picture.at(y, x));
    }
  }
  return picture;
}

}  // namespace

RgbaImage overlay_picture(const QuantityMap& map, const render::Shading& shading) {
  return shaded(map, shading, [](std::uint8_t* pixel) { pixel[kAlpha] = 0; });
}

RgbaImage map_picture(const QuantityMap& map, const render::Shading& shading) {
  return shaded(map, shading, [&shading](std::uint8_t* pixel) {
    std::copy(shading.map.invalid.begin(), shading.map.invalid.end(), pixel);
  });
}

RgbaImage blended(const RgbaImage& under, const RgbaImage& over, double opacity) {
  RgbaImage picture = under;
  const int weight = static_cast<int>(std::lround(opacity * 256));
  for (int y = 0; y < picture.height(); ++y) {
    std::uint8_t* below = picture.row(y);
    const std::uint8_t* above = over.row(y);
    for (int x = 0; x < picture.width(); ++x, below += 4, above += 4) {
      const int part = above[kAlpha] * weight / 255;
      for (int c = 0; c < kAlpha; ++c) {
        below[c] = static_cast<std::uint8_t>(below[c] + (above[c] - below[c]) * part / 256);
      }
    }
  }
  return picture;
}

RgbaImage horizontal_epi_picture(const LightField& light_field, ViewIndex view, int y) {
  check_line("row", y, light_field.height());
  return stretched(render::shade_samples(horizontal_epi(light_field, view, y).view()));
}

RgbaImage vertical_epi_picture(const LightField& light_field, ViewIndex view, int x) {
  check_line("column", x, light_field.width());
  return transposed(stretched(render::shade_samples(vertical_epi(light_field, view, x).view())));
}

render::Shading shading_of(render::Quantity quantity, Interval disparity_range,
                           const ShadingChoice& choice) {
  render::Shading shading = render::default_shading(quantity, disparity_range);
  if (!choice.color_map.empty()) shading.map = render::color_map(choice.color_map);
  if (choice.range) shading.range = *choice.range;
  return shading;
}

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
