// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/io/models/sidecar_maps/layered_folder.h"

#include "engine/io/base/image_file.h"
#include "engine/io/base/npy.h"
#include "engine/io/open.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope::test {
namespace {

double texture(double x, double y, double phase) {
  return 40 * std::sin(0.9 * x + 0.4 * y + phase) + 30 * std::sin(0.3 * x - 0.8 * y + 2 * phase);
}

int count(const Scene& scene, const std::string& kind, bool is_used) {
  for (const FileUse& use : scene.convention.files) {
    if (use.kind == kind && use.is_used == is_used) return use.count;
  }
  return 0;
}

}  // namespace

LayeredScene::LayeredScene(GridShape grid, int height, int width)
    : views(grid, height, width, 3),
      disparity(grid, height, width),
      depth(grid, height, width),
      labels(grid, height, width) {
  const ViewIndex center = grid.center();
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        // (x, y) shows the point that the center view has at (x + d·du, y + d·dv).
        const auto in_center = [&](double d) {
          return std::pair(x + d * (view.u - center.u), y + d * (view.v - center.v));
        };
        const auto [nx, ny] = in_center(kNear);
        const bool is_near =
            nx > 0.3 * width && nx < 0.6 * width && ny > 0.3 * height && ny < 0.7 * height;
        const float d = is_near ? kNear : kFar;
        const auto [px, py] = in_center(d);
        const double grey = (is_near ? 170 : 80) + texture(px, py, is_near ? 1.3 : 0);
        for (int c = 0; c < 3; ++c) {
          views.view(view).at(y, x, c) = static_cast<std::uint8_t>(std::lround(grey));
        }
        disparity.view(view).at(y, x) = d;
        depth.view(view).at(y, x) = kA / (d + kB);
        labels.view(view).at(y, x) = is_near ? 2 : 5;
      }
    }
  }
}

LayeredFolder::Name LayeredFolder::named(const std::string& form) {
  return [form](int row, int column) { return fmt::format(fmt::runtime(form), row, column); };
}

std::filesystem::path LayeredFolder::path(const std::string& name) const {
  const std::filesystem::path folder = folder_->path().toStdString();
  return name.empty() ? folder : folder / name;
}

std::filesystem::path LayeredFolder::place(const std::string& name) const {
  std::filesystem::create_directories(path(name).parent_path());
  return path(name);
}

Scene LayeredFolder::open(const std::string& name, const io::OpenOptions& options) const {
  return io::open_scene(path(name), options, Progress(2));
}

void LayeredFolder::for_views(
    const Name& name,
    const std::function<void(const std::filesystem::path&, ViewIndex)>& write) const {
  const GridShape grid = scene.views.grid();
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    write(place(name(view.v + 1, view.u + 1)), view);
  }
}

void LayeredFolder::write_views(const Name& name) const {
  for_views(name,
            [&](const auto& file, ViewIndex view) { io::write_png(file, scene.views.view(view)); });
}

void LayeredFolder::write_npy(const Name& name, const ViewStack<float>& maps, double factor) const {
  for_views(name, [&](const auto& file, ViewIndex view) {
    write_npy(std::filesystem::relative(file, path()).string(), maps.view(view), factor);
  });
}

void LayeredFolder::write_npy(const Name& name, const ViewStack<std::int32_t>& maps,
                              int add) const {
  for_views(name, [&](const auto& file, ViewIndex view) {
    write_npy(std::filesystem::relative(file, path()).string(), maps.view(view), add);
  });
}

void LayeredFolder::write_npy(const std::string& name, ImageView<const float> map,
                              double factor) const {
  std::vector<float> values;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      values.push_back(static_cast<float>(factor * map.at(y, x)));
    }
  }
  io::write_npy<float>(place(name),
                       {static_cast<std::size_t>(map.height), static_cast<std::size_t>(map.width)},
                       values);
}

void LayeredFolder::write_npy(const std::string& name, ImageView<const std::int32_t> map,
                              int add) const {
  std::vector<std::int32_t> values;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) values.push_back(map.at(y, x) + add);
  }
  io::write_npy<std::int32_t>(
      place(name), {static_cast<std::size_t>(map.height), static_cast<std::size_t>(map.width)},
      values);
}

void LayeredFolder::write_colors(const std::string& name, ImageView<const std::int32_t> map,
                                 const std::function<Rgb(int)>& color) const {
  Image<std::uint8_t> picture(map.height, map.width, 3);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const Rgb rgb = color(map.at(y, x));
      for (int c = 0; c < 3; ++c) picture.at(y, x, c) = rgb[static_cast<std::size_t>(c)];
    }
  }
  io::write_png(place(name), picture.view());
}

int count_used(const Scene& scene, const std::string& kind) {
  return count(scene, kind, true);
}

int count_unused(const Scene& scene, const std::string& kind) {
  return count(scene, kind, false);
}

bool warns_of(const Scene& scene, const std::string& text) {
  return std::ranges::any_of(scene.convention.warnings, [&](const std::string& warning) {
    return warning.find(text) != std::string::npos;
  });
}

}  // namespace episcope::test
