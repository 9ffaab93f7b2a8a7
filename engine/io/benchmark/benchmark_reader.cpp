// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/benchmark/benchmark_reader.h"

#include "engine/core/error.h"
#include "engine/io/benchmark/benchmark_names.h"
#include "engine/io/benchmark/benchmark_views.h"
#include "engine/io/benchmark/config_file.h"
#include "engine/io/benchmark/high_res_files.h"
#include "engine/io/beside/beside.h"
#include "engine/io/beside/map_scale.h"
#include "engine/io/beside/near_side.h"
#include "engine/io/grid/decode_image.h"
#include "engine/io/grid/load_views.h"
#include "engine/io/maps/pfm.h"
#include "engine/io/maps/sample_range.h"
#include "engine/io/open/assemble_scene.h"
#include "engine/io/open/folder_account.h"
#include "engine/io/open/grid_option.h"
#include "engine/io/open/scene_folder.h"
#include "engine/io/open/scene_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <sstream>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// The folder of a scene, and what was read of it so far.
struct SceneFolder {
  fs::path path;
  FolderAccount account;
};

std::optional<Interval> promised_range(const ConfigFile& config) {
  const auto min = config.number("disp_min");
  const auto max = config.number("disp_max");
  if (!min || !max || !(*min < *max)) return std::nullopt;
  return Interval{*min, *max};
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

Size size_of(const LightField::Samples& samples) {
  return std::visit([](const auto& stack) { return Size{stack.height(), stack.width()}; }, samples);
}

template <class T>
void require_size(const fs::path& path, const Image<T>& map, Size size) {
  if (map.height() == size.height && map.width() == size.width) return;
  throw IoError(
      path, fmt::format("this map has {}×{} px, but the views have {}×{} px; remove or replace it",
                        map.width(), map.height(), size.width, size.height));
}

/// Copies a map into a view of the field; values that are not finite become invalid.
void store(const Image<float>& map, ViewIndex view, DisparityField& field) {
  const auto disparity = field.disparity.view(view);
  const auto valid = field.valid.view(view);
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const float d = map.at(y, x);
      valid.at(y, x) = std::isfinite(d) ? 1 : 0;
      disparity.at(y, x) = std::isfinite(d) ? d : 0;
    }
  }
}

/// Of a map that was written as a gray picture of three channels, one of them. Throws IoError if
/// they differ.
Image<float> one_channel(const fs::path& path, Image<float> map) {
  if (map.channels() == 1) return map;
  Image<float> first(map.height(), map.width());
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const float value = map.at(y, x, 0);
      const bool is_gray =
          std::isnan(value) || (map.at(y, x, 1) == value && map.at(y, x, 2) == value);
      if (!is_gray) {
        throw IoError(path, "this map has 3 channels, but 1 is expected; remove or replace it");
      }
      first.at(y, x) = value;
    }
  }
  return first;
}

Image<float> read_map(const fs::path& path, Size size) {
  Image<float> map = read_pfm(path);
  require_size(path, map, size);
  return one_channel(path, std::move(map));
}

/// Depth of the benchmark is in metres or in millimetres, told apart by the focus distance.
void depth_to_disparity(const CameraGrid& camera, Image<float>& map) {
  double nearest_difference[2] = {0, 0};
  for (const float depth : map) {
    if (!std::isfinite(depth) || depth <= 0) continue;
    nearest_difference[0] += std::abs(std::log(depth / *camera.cam_distance));
    nearest_difference[1] += std::abs(std::log(1000 * depth / *camera.cam_distance));
  }
  const double unit_mm = nearest_difference[1] < nearest_difference[0] ? 1000 : 1;
  for (float& value : map) {
    value = static_cast<float>(camera.disparity_from_depth(unit_mm * value));
  }
}

/// Of the centre view only where `views` says so.
DisparityField read_truth(SceneFolder& scene, GridShape grid, Size size, const CameraGrid& camera,
                          MapViews views, ConventionReport& report, const Progress& progress) {
  const fs::path& folder = scene.path;
  const auto per_view = [&](int i) { return folder / disparity_file_name(i); };
  bool has_all = true;
  for (int i = 0; i < grid.count() && has_all; ++i) has_all = is_there(per_view(i));
  const auto make = [&](GridShape part, ViewIndex first) {
    return DisparityField{ViewStack<float>(part, size.height, size.width, 1, first),
                          ViewStack<std::uint8_t>(part, size.height, size.width, 1, first)};
  };
  if (has_all) {
    report.units = "disparity as stored in gt_disp_lowres_Cam*.pfm";
    const bool all = views == MapViews::All;
    const GridShape part = all ? grid : GridShape{1, 1};
    const ViewIndex first = all ? ViewIndex{} : grid.center();
    DisparityField field = make(part, first);
    for (int i = 0; i < part.count(); ++i) {
      progress.check();
      const ViewIndex view = part.view_at(i, first);
      const fs::path file = per_view(view.v * grid.u + view.u);
      store(read_map(file, size), view, field);
      scene.account.use(file, "disparity maps");
      progress.report((i + 1.0) / part.count());
    }
    return field;
  }
  DisparityField field;
  const fs::path disparity = folder / kCenterDisparity;
  const fs::path depth = folder / kCenterDepth;
  if (is_there(disparity)) {
    report.units = "disparity as stored in gt_disp_lowres.pfm";
    field = make({1, 1}, grid.center());
    store(read_map(disparity, size), grid.center(), field);
    scene.account.use(disparity, "disparity map of the centre view");
  } else if (is_there(depth) && camera.is_known() && camera.cam_distance) {
    report.units = "disparity from gt_depth_lowres.pfm and the camera of parameters.cfg";
    field = make({1, 1}, grid.center());
    Image<float> map = read_map(depth, size);
    depth_to_disparity(camera, map);
    store(map, grid.center(), field);
    scene.account.use(depth, "depth map of the centre view");
  } else {
    report.units = "no truth in this folder";
  }
  return field;
}

/// Disparity whose sign is not that of the benchmark: views show what hides what.
void correct_sign(const LightField::Samples& samples, DisparityField& field,
                  ConventionReport& report) {
  if (field.empty()) return;
  const GridShape grid = grid_of(samples);
  const ViewIndex at = field.contains(grid.center()) ? grid.center() : field.disparity.first();
  const Explanation explanation = explain_views(samples, at, field.view(at), 1);
  if (!explanation.is_good()) return;
  const NearSide side = find_near_side(samples, at, field.view(at), 1, explanation);
  if (!side.is_decided() || side.larger_is_nearer()) return;
  std::transform(field.disparity.data(), field.disparity.data() + field.disparity.size(),
                 field.disparity.data(), std::negate<>());
  report.units += ", negative = nearer";
  report.units_check = fmt::format(
      "smaller values hide others in other views (grey error {:.2f}, the hidden ones {:.2f}, {} "
      "pairs)",
      side.smaller, side.larger, side.points);
}

void read_regions(SceneFolder& scene, Size size, GroundTruth& truth) {
  std::set<fs::path> files;
  for (const auto& entry : fs::directory_iterator(scene.path)) files.insert(entry.path());
  for (const fs::path& path : files) {
    const std::string region = region_of(path, kMaskSuffix);
    if (region.empty()) continue;
    const Image<std::int32_t> numbers = decode_numbers(path);
    require_size(path, numbers, size);
    Image<std::uint8_t> mask(size.height, size.width);
    const std::int32_t largest = is_numbered_region(region) ? 255 : 1;
    std::transform(numbers.begin(), numbers.end(), mask.begin(), [largest](std::int32_t value) {
      return static_cast<std::uint8_t>(std::clamp(value, 0, largest));
    });
    truth.regions.emplace(region, std::move(mask));
    scene.account.use(path, "region masks");
  }
}

void find_high_res(SceneFolder& scene, Size size, GroundTruth& truth) {
  const HighResFiles files = find_high_res_files(scene.path);
  truth.high_res = high_res_truth(files, size.height, size.width);
  if (!truth.high_res) return;
  scene.account.use(files.disparity, "disparity map of the centre view in high resolution");
  scene.account.use(files.masks, "region masks in high resolution");
}

void read_object_ids(SceneFolder& scene, GridShape grid, Size size, GroundTruth& truth) {
  const fs::path path = scene.path / kObjectIds;
  if (!is_there(path)) return;
  scene.account.use(path, "label map of the centre view");
  const Image<std::int32_t> ids = decode_numbers(path);
  require_size(path, ids, size);
  truth.labels = ViewStack<std::int32_t>({1, 1}, size.height, size.width, 1, grid.center());
  std::copy_n(ids.data(), ids.size(), truth.labels.data());
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
  SceneFolder files{folder, FolderAccount(folder)};
  std::optional<ConfigFile> config;
  if (is_there(folder / kBenchmarkConfig)) config.emplace(folder / kBenchmarkConfig);
  const std::optional<GridShape> given = given_grid(options);
  const ViewFiles views = benchmark_views(folder, config, given);
  files.account.add_folder(views.files.front().parent_path());
  files.account.use(views.files, "views");
  if (config) files.account.use(folder / kBenchmarkConfig, "parameter files");
  Scene scene;
  ConventionReport& report = scene.convention;
  report.format = "2016 benchmark folder";
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
  if (config) info.disparity_range = promised_range(*config);
  progress.step("reading views");
  LightField::Samples samples = load_views(
      views,
      [&](const Image<std::uint8_t>& center) {
        if (options.on_center_view) options.on_center_view(center, info, views.grid);
      },
      progress.part(0, 0.85));
  settle_range(samples, options.levels, report);
  progress.step("reading truth");
  const Size size = size_of(samples);
  if (config) {
    compare_size(*config, size, report);
    compare_grid(*config, views.grid, report);
    info.camera = read_camera(folder, *config, size, report);
  }
  GroundTruth truth;
  truth.field = read_truth(files, views.grid, size, info.camera, options.map_views(), report,
                           progress.part(0.85, 0.9));
  correct_sign(samples, truth.field, report);
  if (truth.field.empty()) {
    // What other programs call it.
    FoundBeside beside = read_beside({views, views.files.front().parent_path(), samples,
                                      info.camera, options.map_views(), options.needs_truth},
                                     {files.account, report}, progress.part(0.9, 0.95));
    truth = std::move(beside.truth);
    info.camera = beside.camera;
    scene.scribbles.labels = std::move(beside.label_infos);
  }
  if (options.needs_truth) {
    read_object_ids(files, views.grid, size, truth);
    read_regions(files, size, truth);
    find_high_res(files, size, truth);
    const auto stated = config ? config->text("scene") : std::nullopt;
    truth.stratified = stratified_scene(stated.value_or(info.name));
  }

  SceneParts parts;
  parts.samples = std::move(samples);
  parts.truth = std::move(truth);
  parts.info = std::move(info);
  parts.expected.reason = "benchmark folders store views in canonical order";
  parts.files = files.account.uses();
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
