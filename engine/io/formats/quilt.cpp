// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/quilt.h"

#include "engine/core/error.h"
#include "engine/core/image.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

struct QuiltName {
  std::string scene;
  GridShape tiles;
};

std::optional<QuiltName> parse_stem(const std::string& stem) {
  static const std::regex kForm(
      "(?:(.*)[_. -])?qs([1-9][0-9]{0,2})x([1-9][0-9]{0,2})a[0-9]*[.]?[0-9]+", std::regex::icase);
  std::smatch parts;
  constexpr std::size_t kLongest = 255;  // the expression recurses
  if (stem.size() > kLongest || !std::regex_match(stem, parts, kForm)) return std::nullopt;
  return QuiltName{parts[1].str(), {std::stoi(parts[3].str()), std::stoi(parts[2].str())}};
}

double aspect_of(const LightField& field) {
  return static_cast<double>(field.width()) / field.height();
}

GridShape tiles_for(const fs::path& path, const LightField& field) {
  const auto stated = quilt_tiles_of_name(path);
  const GridShape own = quilt_tiles_of(field);
  if (!stated) return own;
  if (stated->count() == own.count()) return *stated;
  throw IoError(
      path,
      fmt::format("the name states {}×{} tiles, but there are {} views in a row; "
                  "name it {}",
                  stated->v, stated->u, own.count(),
                  quilt_path(without_quilt_tiles(path.stem().string()) + ".png", field).string()));
}

template <class T>
Image<T> join_tiles(const ViewStack<T>& views, GridShape tiles) {
  Image<T> picture(views.height() * tiles.v, views.width() * tiles.u, views.channels());
  const int row = views.grid().center().v;
  const std::size_t length = static_cast<std::size_t>(views.width()) * views.channels();
  for (int u = 0; u < views.grid().u; ++u) {
    const auto view = views.view({row, u});
    const ViewIndex tile = quilt_tile(tiles, u);
    for (int y = 0; y < views.height(); ++y) {
      std::copy_n(
          view.row(y), length,
          picture.row(tile.v * views.height() + y) + static_cast<std::size_t>(tile.u) * length);
    }
  }
  return picture;
}

}  // namespace

std::optional<GridShape> quilt_tiles_of_name(const fs::path& path) {
  if (!is_image_name(path)) return std::nullopt;
  const auto name = parse_stem(path.stem().string());
  return name ? std::optional(name->tiles) : std::nullopt;
}

std::string without_quilt_tiles(const std::string& stem) {
  const auto name = parse_stem(stem);
  return name && !name->scene.empty() ? name->scene : stem;
}

ViewIndex quilt_tile(GridShape tiles, int view) {
  return {tiles.v - 1 - view / tiles.u, view % tiles.u};
}

GridShape quilt_tiles_of(const LightField& field) {
  const int count = field.grid().u;
  const auto skew = [&](int columns) {
    const double rows = static_cast<double>(count) / columns;
    return std::abs(std::log(columns * aspect_of(field) / rows));
  };
  int best = count;
  for (int columns = 1; columns < count; ++columns) {
    if (count % columns == 0 && skew(columns) < skew(best)) best = columns;
  }
  return {count / best, best};
}

fs::path quilt_path(const fs::path& path, const LightField& field) {
  if (quilt_tiles_of_name(path)) return path;
  const GridShape tiles = quilt_tiles_of(field);
  fs::path named = path;
  return named.replace_filename(fmt::format("{}_qs{}x{}a{:.4g}.png", path.stem().string(), tiles.u,
                                            tiles.v, aspect_of(field)));
}

void write_quilt(const fs::path& path, const Scene& scene, const Progress& progress) {
  progress.check();
  progress.step("writing " + path.filename().string());
  const LightField& field = *scene.light_field;
  if (field.grid().u < 2) {
    throw IoError(path,
                  "a quilt holds a row of views, but these are in one column; choose another form");
  }
  const GridShape tiles = tiles_for(path, field);
  std::visit(
      [&]<class T>(const ViewStack<T>& views) {
        if constexpr (std::is_same_v<T, float>) {
          throw IoError(path,
                        "a quilt holds 8 or 16 bit, but these views are float; choose a form that "
                        "holds float samples, for example .npy");
        } else {
          const Image<T> picture = join_tiles(views, tiles);
          progress.check();
          write_png(path, picture.view());
        }
      },
      field.samples());
  progress.report(1);
}

}  // namespace episcope::io
