// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/benchmark/benchmark_views.h"

#include "engine/core/array/whole_int.h"
#include "engine/core/error.h"
#include "engine/core/text/character.h"
#include "engine/core/text/suffix.h"
#include "engine/io/benchmark/benchmark_names.h"
#include "engine/io/grid/decode_image.h"
#include "engine/io/grid/grid_with_gaps.h"
#include "engine/io/grid/image_grid_probe.h"
#include "engine/io/open/grid_option.h"
#include "engine/io/open/scene_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

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

/// Rows and columns that the parameter file promises, unless the files are numbered without a gap
/// and make another square: then it is that of another scene, or of all views of which these are
/// some.
GridShape promised_grid(GridShape promised, const std::map<int, fs::path>& found) {
  const auto count = static_cast<int>(found.size());
  const int side = static_cast<int>(std::lround(std::sqrt(count)));
  const bool has_gap = found.empty() || found.rbegin()->first - found.begin()->first + 1 != count;
  constexpr int kSmallestSide = 3;
  if (has_gap || side * side != count || promised.count() == count) return promised;
  if (promised.count() > count && side < kSmallestSide) return promised;
  return {side, side};
}

/// The number in the name of a view, whatever its padding, case and format.
std::optional<int> view_number(const fs::path& path) {
  constexpr std::size_t kMostDigits = 6;
  const std::string stem = lower_case(path.stem().string());
  const std::string prefix = lower_case(kViewPrefix);
  if (!stem.starts_with(prefix) || !is_image_name(path)) return std::nullopt;
  const std::string digits = stem.substr(prefix.size());
  const bool is_number =
      !digits.empty() && digits.size() <= kMostDigits && std::ranges::all_of(digits, is_digit);
  return is_number ? std::optional(std::stoi(digits)) : std::nullopt;
}

/// Of several files of one number the one that the benchmark would name so, or the first.
std::map<int, fs::path> views_in(const fs::path& folder) {
  std::map<int, fs::path> views;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const fs::path& path = entry.path();
    const auto number = view_number(path);
    if (!number) continue;
    const bool is_exact = path.filename() == view_file_name(*number);
    const auto [place, is_new] = views.try_emplace(*number, path);
    const bool has_exact = place->second.filename() == view_file_name(*number);
    if (!is_new && (is_exact || (!has_exact && path < place->second))) place->second = path;
  }
  return views;
}

/// Of the folder, else of the only one inside it that has any ("input", "views").
std::map<int, fs::path> numbered_views(const fs::path& folder) {
  std::map<int, fs::path> views = views_in(folder);
  if (!views.empty()) return views;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.is_directory(error)) continue;
    std::map<int, fs::path> inside = views_in(entry.path());
    if (inside.empty()) continue;
    if (!views.empty()) return {};
    views = std::move(inside);
  }
  return views;
}

std::string truth_of(const fs::path& folder, GridShape grid) {
  const bool has_all = is_there(folder / disparity_file_name(0)) &&
                       is_there(folder / disparity_file_name(grid.count() - 1));
  if (has_all) return "disparity of all views";
  if (is_there(folder / kCenterDisparity)) return "disparity of the centre view";
  return is_there(folder / kCenterDepth) ? "depth of the centre view" : "";
}

std::vector<long long> counted(int length) {
  std::vector<long long> numbers(static_cast<std::size_t>(length));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

}  // namespace

int count_benchmark_views(const fs::path& folder) {
  return static_cast<int>(numbered_views(folder).size());
}

BenchmarkViews benchmark_views(const fs::path& folder, const std::optional<ConfigFile>& config,
                               const std::optional<GridShape>& given) {
  const std::map<int, fs::path> found = numbered_views(folder);
  const auto count = static_cast<int>(found.size());
  GridShape grid;
  std::optional<double> columns, rows;
  if (config) {
    columns = config->number("num_cams_x");
    rows = config->number("num_cams_y");
  }
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
    grid = promised_grid(grid, found);
  } else {
    grid = square_grid(folder, count);
  }
  const int first = !found.contains(0) && found.contains(grid.count()) ? 1 : 0;
  GridWithGaps views{.rows = counted(grid.v), .columns = counted(grid.u), .numbering = "from 0"};
  for (int i = first; i < grid.count() + first; ++i) {
    const auto view = found.find(i);
    views.files.push_back(view == found.end() ? fs::path() : view->second);
  }
  if (views.missing() == 0) return {.views = {grid, views.files}, .gaps = {}};
  const std::optional<PartOfGrid> part = part_to_open(views);
  if (part) return {.views = files_of_part(views, *part), .gaps = part_text(views, *part)};
  const auto missing = std::ranges::find_if(views.files, &fs::path::empty) - views.files.begin();
  throw IoError(
      folder / view_file_name(first + static_cast<int>(missing)),
      fmt::format("this view is missing: {} of {} files input_Cam*.png were found; add it", count,
                  grid.count()));
}

SceneProbe probe_benchmark(const fs::path& folder, const OpenOptions& options) {
  std::optional<ConfigFile> config;
  if (is_there(folder / kBenchmarkConfig)) config.emplace(folder / kBenchmarkConfig);
  SceneProbe probe = probe_views(benchmark_views(folder, config, given_grid(options)).views);
  probe.truth = truth_of(folder, probe.grid);
  if (is_there(folder / kObjectIds)) probe.labels = "labels of the centre view";
  return probe;
}

}  // namespace episcope::io
