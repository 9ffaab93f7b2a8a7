// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/benchmark/benchmark_views.h"

#include "engine/core/array/whole_int.h"
#include "engine/core/error.h"
#include "engine/io/benchmark/benchmark_names.h"
#include "engine/io/grid/image_grid_probe.h"
#include "engine/io/open/grid_option.h"
#include "engine/io/open/scene_folder.h"

#include <fmt/format.h>

#include <cmath>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

GridShape square_grid(const fs::path& folder, int count) {
  const int side = static_cast<int>(std::lround(std::sqrt(count)));
  if (count > 0 && side * side == count) return {side, side};
  throw IoError(folder, fmt::format("there is no {} and the {} files input_Cam*.png do not form a "
                                    "square grid; add the missing files or give the rows and "
                                    "columns by --grid",
                                    kBenchmarkConfig, count));
}

std::string truth_of(const fs::path& folder, GridShape grid) {
  const bool has_all = is_there(folder / disparity_file_name(0)) &&
                       is_there(folder / disparity_file_name(grid.count() - 1));
  if (has_all) return "disparity of all views";
  if (is_there(folder / kCenterDisparity)) return "disparity of the centre view";
  return is_there(folder / kCenterDepth) ? "depth of the centre view" : "";
}

}  // namespace

int count_benchmark_views(const fs::path& folder) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    count += name.starts_with(kViewPrefix) && name.ends_with(".png") ? 1 : 0;
  }
  return count;
}

ViewFiles benchmark_views(const fs::path& folder, const std::optional<ConfigFile>& config,
                          const std::optional<GridShape>& given) {
  const int count = count_benchmark_views(folder);
  GridShape grid;
  const auto columns = config ? config->number("num_cams_x") : std::nullopt;
  const auto rows = config ? config->number("num_cams_y") : std::nullopt;
  if (given) {
    grid = *given;
  } else if (columns && rows) {
    grid = {whole_int(*rows).value_or(0), whole_int(*columns).value_or(0)};
    if (grid.v < 1 || grid.u < 1 || grid.v > 1000 || grid.u > 1000) {
      throw IoError(
          folder / kBenchmarkConfig,
          fmt::format(
              "num_cams_x and num_cams_y are {} and {}, which is not possible; correct this file",
              *columns, *rows));
    }
  } else {
    grid = square_grid(folder, count);
  }
  ViewFiles views{grid, {}};
  for (int i = 0; i < grid.count(); ++i) {
    views.files.push_back(folder / view_file_name(i));
    if (!is_there(views.files.back())) {
      throw IoError(
          views.files.back(),
          fmt::format("this view is missing: {} of {} files input_Cam*.png were found; add it",
                      count, grid.count()));
    }
  }
  return views;
}

SceneProbe probe_benchmark(const fs::path& folder, const OpenOptions& options) {
  std::optional<ConfigFile> config;
  if (is_there(folder / kBenchmarkConfig)) config.emplace(folder / kBenchmarkConfig);
  SceneProbe probe = probe_views(benchmark_views(folder, config, given_grid(options)));
  probe.truth = truth_of(folder, probe.grid);
  if (is_there(folder / kObjectIds)) probe.labels = "labels of the centre view";
  return probe;
}

}  // namespace episcope::io
