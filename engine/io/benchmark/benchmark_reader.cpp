// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/benchmark/benchmark_reader.h"

#include "engine/core/error.h"
#include "engine/io/benchmark/benchmark_names.h"
#include "engine/io/benchmark/benchmark_truth.h"
#include "engine/io/benchmark/benchmark_views.h"
#include "engine/io/benchmark/config_file.h"
#include "engine/io/beside/beside.h"
#include "engine/io/grid/grid_with_gaps.h"
#include "engine/io/grid/load_views.h"
#include "engine/io/maps/sample_range.h"
#include "engine/io/open/assemble_scene.h"
#include "engine/io/open/folder_account.h"
#include "engine/io/open/grid_option.h"
#include "engine/io/open/scene_folder.h"
#include "engine/io/open/scene_name.h"
#include "engine/io/order/list_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

std::optional<Interval> promised_range(const ConfigFile& config) {
  const auto min = config.number("disp_min");
  const auto max = config.number("disp_max");
  if (!min || !max || !(*min < *max)) return std::nullopt;
  return Interval{*min, *max};
}

/// A range that holds the truth only with the other sign is that of disparities of the other sign.
void correct_promise(const DisparityField& truth, std::optional<Interval>& promised,
                     ConventionReport& report) {
  if (truth.empty() || !promised) return;
  Interval range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < truth.disparity.size(); ++i) {
    if (!truth.valid.empty() && truth.valid.data()[i] == 0) continue;
    const double value = truth.disparity.data()[i];
    range = {std::min(range.min, value), std::max(range.max, value)};
  }
  const double margin = 0.1 * promised->length();
  const auto holds = [&](const Interval& one) {
    return one.min - margin <= range.min && range.max <= one.max + margin;
  };
  const Interval reversed{-promised->max, -promised->min};
  if (range.min > range.max || holds(*promised) || !holds(reversed)) return;
  promised = reversed;
  report.warnings.push_back(
      fmt::format("disp_min and disp_max of {} have the other sign than the truth, in which larger "
                  "values are nearer; they were negated.",
                  kBenchmarkConfig));
}

void tell_values_without_number(const ConfigFile& config, ConventionReport& report) {
  for (const std::string& value : config.values_without_number(
           {"num_cams_x", "num_cams_y", "image_resolution_x_px", "image_resolution_y_px",
            "disp_min", "disp_max", "focal_length_mm", "sensor_size_mm", "baseline_mm",
            "focus_distance_m"})) {
    report.warnings.push_back(
        fmt::format("{}: {}, which is not a number; it is not used.", kBenchmarkConfig, value));
  }
}

struct Size {
  int height = 0;
  int width = 0;
};

/// The size in the file only repeats that of the views, which counts.
void compare_size(const ConfigFile& config, Size size, ConventionReport& report) {
  const auto compare = [&](const char* key, int length) {
    const auto stated = config.number(key);
    if (!stated || *stated == length) return;
    std::ostringstream text;
    text << key << " of " << kBenchmarkConfig << " is " << *stated << ", but the views have "
         << length << " px; the size of the views is used.";
    report.warnings.push_back(text.str());
  };
  compare("image_resolution_x_px", size.width);
  compare("image_resolution_y_px", size.height);
}

/// The number of files counts where they fit no grid of that many cameras.
void compare_grid(const ConfigFile& config, GridShape grid, ConventionReport& report) {
  const auto rows = config.number("num_cams_y");
  const auto columns = config.number("num_cams_x");
  if (!rows || !columns || (*rows == grid.v && *columns == grid.u)) return;
  report.warnings.push_back(
      fmt::format("{} promises {}×{} views, but the files are {}×{}; correct num_cams_x and "
                  "num_cams_y.",
                  kBenchmarkConfig, *rows, *columns, grid.v, grid.u));
}

/// Unknown if the file has none of its keys; if some are missing or wrong, a warning says so.
CameraGrid read_camera(const fs::path& folder, const ConfigFile& config, Size size,
                       ConventionReport& report) {
  BenchmarkCamera camera;
  camera.larger_side_px = std::max(size.width, size.height);
  const std::pair<const char*, double*> keys[] = {{"focal_length_mm", &camera.focal_length_mm},
                                                  {"sensor_size_mm", &camera.sensor_size_mm},
                                                  {"baseline_mm", &camera.baseline_mm},
                                                  {"focus_distance_m", &camera.focus_distance_m}};
  std::string missing;
  int found = 0;
  for (const auto& [key, value] : keys) {
    const auto number = config.number(key);
    if (!number) missing += (missing.empty() ? "" : ", ") + std::string(key);
    *value = number.value_or(0);
    found += number ? 1 : 0;
  }
  if (found == 0) return {};
  const std::string left_out =
      "The camera of " + (folder / kBenchmarkConfig).string() + " is ignored: ";
  if (!missing.empty()) {
    report.warnings.push_back(left_out + missing + " is missing; add it.");
    return {};
  }
  try {
    return camera_grid_from_benchmark(camera);
  } catch (const InvalidInput& error) {
    report.warnings.push_back(left_out + error.what() + ".");
    return {};
  }
}

/// Puts the files of a grid that is not square into the rows and columns that the views show, if
/// these are exchanged, or counted otherwise than row by row; whether it did.
bool arrange_as_seen(const LightField::Samples& samples, ViewFiles& views, ConventionReport& report,
                     const Progress& progress) {
  const GridShape promised = views.grid;
  if (promised.v == promised.u || promised.v == 1 || promised.u == 1) return false;
  const ListLayout seen = find_list_layout(samples, progress);
  const bool is_as_promised = seen.grid == promised && seen.order == ListOrder::Rows;
  const bool is_of_these_sides =
      seen.grid == promised || seen.grid == GridShape{promised.u, promised.v};
  if (!seen.is_decided || is_as_promised || !is_of_these_sides) return false;
  ViewFiles arranged{seen.grid, std::vector<std::filesystem::path>(views.files.size())};
  for (int i = 0; i < seen.grid.count(); ++i) {
    const ViewIndex place = seen.place(i);
    const int number = place.v * seen.grid.u + place.u;
    arranged.files[static_cast<std::size_t>(number)] = views.files[static_cast<std::size_t>(i)];
  }
  views = std::move(arranged);
  report.warnings.push_back(fmt::format("The views are not {}×{}, row by row, but {}: {}.",
                                        promised.v, promised.u, layout_text(seen), seen.evidence));
  return true;
}

Size size_of(const LightField::Samples& samples) {
  return std::visit([](const auto& stack) { return Size{stack.height(), stack.width()}; }, samples);
}

bool is_benchmark_folder(const fs::path& folder, const OpenOptions& options) {
  if (is_there(folder / kBenchmarkConfig)) return true;
  // Without it only truth tells a scene of the benchmark from any list of views, whose rows and
  // columns its images tell if they are not a square.
  const bool has_truth = is_there(folder / disparity_file_name(0)) ||
                         is_there(folder / kCenterDisparity) || is_there(folder / kCenterDepth);
  const int count = has_truth ? count_benchmark_views(folder) : 0;
  const auto side = static_cast<int>(std::lround(std::sqrt(count)));
  return count > 0 && (side * side == count || !options.grid.empty());
}

Scene read_benchmark(const fs::path& folder, const OpenOptions& options, const Progress& progress) {
  FolderAccount account(folder);
  std::optional<ConfigFile> config;
  if (is_there(folder / kBenchmarkConfig)) config.emplace(folder / kBenchmarkConfig);
  const std::optional<GridShape> given = given_grid(options);
  BenchmarkViews found = benchmark_views(folder, config, given);
  ViewFiles& views = found.views;
  account.add_folder(views.files.front().parent_path());
  Scene scene;
  ConventionReport& report = scene.convention;
  report.format = "2016 benchmark folder";
  if (!found.gaps.empty()) report.warnings.push_back(found.gaps);
  if (!config && !given) {
    report.warnings.push_back(
        fmt::format("There is no parameters.cfg: the grid of {}×{} views was inferred from the "
                    "number of files.",
                    views.grid.v, views.grid.u));
  }
  LightFieldInfo info{scene_name(folder),
                      folder.string(),
                      {},
                      std::nullopt,
                      {.reader = "benchmark2016", .options = {}}};
  if (config) {
    tell_values_without_number(*config, report);
    info.disparity_range = promised_range(*config);
  }
  progress.step("reading views");
  const auto show_center = [&](const Image<std::uint8_t>& center) {
    if (options.on_center_view) options.on_center_view(center, info, views.grid);
  };
  UsableViews usable = load_usable_views(views, show_center, progress.part(0, 0.85));
  if (usable.kept) {
    views = std::move(usable.views);
    report.warnings.push_back(std::move(usable.warning));
  }
  LightField::Samples samples = std::move(usable.samples);
  if (!given && !views.part && arrange_as_seen(samples, views, report, progress)) {
    samples = load_views(views, show_center, progress.part(0, 0.85));
  }
  account.use(views.files, "views");
  account.leave_out(views.left_out, kViewsLeftOut);
  account.leave_out(views.unusable, kUnusableViews);
  if (config) account.use(folder / kBenchmarkConfig, "parameter files");
  settle_range(samples, options.levels, report);
  progress.step("reading truth");
  const Size size = size_of(samples);
  if (config) {
    compare_size(*config, size, report);
    compare_grid(*config, views.whole_grid(), report);
    info.camera = read_camera(folder, *config, size, report);
  }
  GroundTruth truth;
  const BesideViews beside_views{views,
                                 views.files.front().parent_path(),
                                 samples,
                                 info.camera,
                                 options.map_views(),
                                 options.needs_truth};
  const BesideNotes notes{account, report};
  truth.field = read_benchmark_disparity(folder, beside_views, notes, progress.part(0.85, 0.9));
  if (truth.field.empty()) {
    // What other programs call it.
    FoundBeside beside = read_beside(beside_views, notes, progress.part(0.9, 0.95));
    truth = std::move(beside.truth);
    info.camera = beside.camera;
    scene.scribbles.labels = std::move(beside.label_infos);
  }
  correct_promise(truth.field, info.disparity_range, report);
  if (options.needs_truth) {
    read_benchmark_masks(folder, beside_views, notes, truth);
    const auto stated = config ? config->text("scene") : std::nullopt;
    truth.stratified = stratified_scene(stated.value_or(info.name));
  }

  SceneParts parts;
  parts.samples = std::move(samples);
  parts.truth = std::move(truth);
  parts.info = std::move(info);
  parts.expected.reason = "benchmark folders store views in canonical order";
  parts.files = account.uses();
  assemble(std::move(parts), options, scene, progress);
  return scene;
}

fs::path find_benchmark(const fs::path& path, const OpenOptions& options) {
  const fs::path folder = scene_folder(path);
  const bool is_one =
      !folder.empty() && !wants_image_grid(options) && is_benchmark_folder(folder, options);
  return is_one ? folder : fs::path();
}

constexpr const char* kOptions[] = {"flip", "crop", "grid", "levels"};

}  // namespace

Reader benchmark_reader() {
  return {.id = "benchmark2016",
          .name = "a scene of the 2016 benchmark",
          .options = kOptions,
          .find = find_benchmark,
          .read = read_benchmark,
          .probe = probe_benchmark};
}

}  // namespace episcope::io
