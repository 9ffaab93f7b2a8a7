// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/picture/movie.h"

#include "engine/core/error.h"
#include "engine/io/movie/movie_file.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace episcope {
namespace {

constexpr double kRefocusRate = 12;  // Pictures per second.

}  // namespace

Movie parallax_movie(GridShape grid, render::CameraPath path, double seconds,
                     const std::function<bool(ViewIndex)>& has_picture,
                     std::function<RgbaImage(ViewIndex)> picture) {
  std::vector<ViewIndex> views = render::camera_path(grid, path);
  std::erase_if(views, [&](ViewIndex view) { return !has_picture(view); });
  if (views.empty())
    throw InvalidInput(
        "none of the views along the path has such a picture; a movie needs a result of all views");
  const auto count = static_cast<int>(views.size());
  return {count, count / seconds, [views = std::move(views), picture = std::move(picture)](int i) {
            return picture(views[i]);
          }};
}

Movie refocus_movie(LightFieldPtr light_field, ViewIndex view, Interval range_px, double seconds) {
  const int count = std::max(2, static_cast<int>(std::lround(seconds * kRefocusRate)));
  std::vector<double> focus = render::there_and_back(range_px.min, range_px.max, count);
  return {count, count / seconds,
          [light_field = std::move(light_field), view, focus = std::move(focus)](int i) {
            return render::shade_samples(render::refocus(*light_field, view, focus[i]).view());
          }};
}

Movie flip_movie(RgbaImage a, RgbaImage b, double seconds) {
  const auto first = std::make_shared<const RgbaImage>(std::move(a));
  const auto second = std::make_shared<const RgbaImage>(std::move(b));
  return {2, 2 / seconds, [first, second](int i) { return RgbaImage(i == 0 ? *first : *second); }};
}

void write_movie(const std::filesystem::path& path, const Movie& movie, int width_shown,
                 const Progress& progress) {
  std::unique_ptr<io::MovieFile> file;
  for (int i = 0; i < movie.count; ++i) {
    progress.check();
    const RgbaImage picture = movie.picture(i);
    if (!file) {
      file = std::make_unique<io::MovieFile>(
          path, io::MovieShape{picture.height(), picture.width(), movie.rate, width_shown});
    }
    file->add(picture.view());
    progress.report(static_cast<double>(i + 1) / movie.count);
  }
  if (file) file->commit();
}

}  // namespace episcope
