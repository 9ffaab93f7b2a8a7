// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/benchmark_reader.h"

#include "engine/core/error.h"

#include "engine/core/finding.h"
#include "engine/core/numbers.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/sample_range.h"
#include "engine/io/formats/benchmark_truth.h"
#include "engine/io/formats/image_grid.h"
#include "engine/io/formats/write_scene.h"
#include "engine/io/models/assemble_scene.h"
#include "engine/io/models/estimated.h"
#include "engine/io/models/load_views.h"
#include "engine/io/models/names/view_files.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/order/list_layout.h"
#include "engine/io/models/sidecar_maps/sidecar_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>
#include <utility>

namespace episcope::io {
namespace {

/// Views of a scene, and what is missing from them.
struct BenchmarkViews {
  ViewFiles views;
  std::string gaps;  ///< A sentence (`part_text`); empty if nothing is missing.
};

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
  if (is_there(folder / kCenterDisparity)) return "disparity of the center view";
  return is_there(folder / kCenterDepth) ? "depth of the center view" : "";
}

std::vector<long long> counted(int length) {
  std::vector<long long> numbers(static_cast<std::size_t>(length));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// Number of images input_Cam* in a folder: with a number of any padding, upper or lower case.
int count_benchmark_views(const fs::path& folder) {
  return static_cast<int>(numbered_views(folder).size());
}

/// Throws InvalidInput if a grid that was given has not as many views as there are files, or
/// contradicts the one that is stated, which has.
void require_grid(const fs::path& folder, GridShape given, GridShape stated, int count) {
  if (given.count() >= count && (given == stated || stated.count() != count)) return;
  throw InvalidInput(fmt::format(
      "{}: there are {} files input_Cam*.png{}, but --grid says {}; leave --grid out{}",
      folder.string(), count,
      stated.count() == count ? fmt::format(" and {} says {}", kBenchmarkConfig, grid_text(stated))
                              : "",
      grid_text(given), stated.count() == count ? ", or correct that file" : ""));
}

/// Views by their index from 0, or from 1, row by row from the top left: of the grid that was
/// given, else that of `config`, else a square; in the folder, or in the only one inside it that
/// has some. If some are missing, the part of the grid without gaps (`part_to_open`). Throws
/// IoError, also if there is no such part; InvalidInput for a grid that cannot be.
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
    require_grid(
        folder, grid,
        {whole_int(rows.value_or(0)).value_or(0), whole_int(columns.value_or(0)).value_or(0)},
        count);
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

/// What names and headers of a scene folder tell. Throws IoError.
SceneProbe probe_benchmark(const fs::path& folder, const OpenOptions& options) {
  std::optional<ConfigFile> config;
  if (is_there(folder / kBenchmarkConfig)) config.emplace(folder / kBenchmarkConfig);
  SceneProbe probe = probe_views(benchmark_views(folder, config, given_grid(options)).views);
  probe.truth = truth_of(folder, probe.grid);
  if (is_there(folder / kObjectIds)) probe.labels = "labels of the center view";
  return probe;
}

std::optional<Interval> promised_range(const ConfigFile& config, ConventionReport& report) {
  const auto min = config.number("disp_min");
  const auto max = config.number("disp_max");
  if (!min || !max) return std::nullopt;
  if (*min < *max) return Interval{*min, *max};
  report.warnings.push_back(
      fmt::format(finding_text("config.no_range"), *min, *max, kBenchmarkConfig));
  return std::nullopt;
}

/// A range that holds the truth only with the other sign has the other sign.
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
  if (range.min > range.max || holds(*promised)) return;
  if (!holds(reversed)) {
    report.warnings.push_back(fmt::format(finding_text("config.range"), kBenchmarkConfig,
                                          promised->min, promised->max, range.min, range.max));
    return;
  }
  promised = reversed;
  report.warnings.push_back(fmt::format(finding_text("config.sign"), kBenchmarkConfig));
}

void tell_values_without_number(const ConfigFile& config, ConventionReport& report) {
  for (const std::string& value : config.values_without_number(
           {"num_cams_x", "num_cams_y", "image_resolution_x_px", "image_resolution_y_px",
            "disp_min", "disp_max", "focal_length_mm", "sensor_size_mm", "baseline_mm",
            "focus_distance_m"})) {
    report.warnings.push_back(
        fmt::format(finding_text("config.no_number"), kBenchmarkConfig, value));
  }
}

struct ViewSize {
  int height = 0;
  int width = 0;
};

/// The size in the file only repeats the size of the views, which counts.
void compare_size(const ConfigFile& config, ViewSize size, ConventionReport& report) {
  const auto compare = [&](const char* key, int length) {
    const auto stated = config.number(key);
    if (!stated || *stated == length) return;
    report.warnings.push_back(
        fmt::format(finding_text("config.size"), key, kBenchmarkConfig, *stated, length));
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
      fmt::format(finding_text("config.grid"), kBenchmarkConfig, *rows, *columns, grid.v, grid.u));
}

/// Unknown if the file has none of its keys; if some are missing or wrong, a warning says so.
CameraGrid read_camera(const fs::path& folder, const ConfigFile& config, ViewSize size,
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
  const auto ignore = [&](const std::string& reason) {
    report.warnings.push_back(
        fmt::format(finding_text("config.camera"), (folder / kBenchmarkConfig).string(), reason));
  };
  if (!missing.empty()) {
    ignore(fmt::format(finding_text("config.missing"), missing));
    return {};
  }
  try {
    return camera_grid_from_benchmark(camera);
  } catch (const InvalidInput& error) {
    ignore(error.what());
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
  report.warnings.push_back(fmt::format(finding_text("views.arranged"), promised.v, promised.u,
                                        layout_text(seen), seen.evidence));
  return true;
}

ViewSize size_of(const LightField::Samples& samples) {
  return std::visit(
      [](const auto& stack) {
        return ViewSize{stack.height(), stack.width()};
      },
      samples);
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

namespace {

// Reads a folder step by step.
class BenchmarkReading {
 public:
  BenchmarkReading(const fs::path& folder, const OpenOptions& options)
      : folder_(folder),
        options_(options),
        account_(folder),
        config_(config_of(folder)),
        given_(given_grid(options)) {}

  Scene read(const Progress& progress) {
    find_views();
    begin_info();
    progress.step("reading views");
    read_views(progress.part(0, 0.7));
    progress.step("reading ground truth");
    compare_config();
    read_truth(progress.part(0.7, 0.8));
    assemble_scene(progress.part(0.8, 1));
    return std::move(scene_);
  }

 private:
  static std::optional<ConfigFile> config_of(const fs::path& folder) {
    if (!is_there(folder / kBenchmarkConfig)) return std::nullopt;
    return ConfigFile(folder / kBenchmarkConfig);
  }

  void find_views() {
    BenchmarkViews found = benchmark_views(folder_, config_, given_);
    views_ = std::move(found.views);
    account_.add_folder(views_.files.front().parent_path());
    report_.format = "2016 benchmark folder";
    if (!found.gaps.empty()) report_.warnings.push_back(found.gaps);
    if (!config_ && !given_) {
      report_.warnings.push_back(
          fmt::format(finding_text("views.no_config"), views_.grid.v, views_.grid.u));
    }
  }
  void begin_info() {
    info_ = {scene_name(folder_),
             folder_.string(),
             {},
             std::nullopt,
             {.reader = "benchmark2016", .options = {}}};
    if (!config_) return;
    tell_values_without_number(*config_, report_);
    info_.disparity_range = promised_range(*config_, report_);
  }
  void read_views(const Progress& progress) {
    const auto show_center = [this](const Image<std::uint8_t>& center) {
      if (options_.on_center_view) options_.on_center_view(center, info_, views_.grid);
    };
    UsableViews usable = load_usable_views(views_, show_center, progress.part(0, 0.9));
    if (usable.kept) {
      views_ = std::move(usable.views);
      report_.warnings.push_back(std::move(usable.warning));
    }
    pixels_ = std::move(usable.pixels);
    if (!given_ && !views_.part &&
        arrange_as_seen(pixels_.samples, views_, report_, progress.part(0.9, 1))) {
      pixels_ = load_views(views_, show_center, progress);
    }
    show_epis(pixels_.samples, options_);
    account_.use(views_.files, "views");
    account_.leave_out(views_.left_out, kViewsLeftOut);
    account_.leave_out(views_.unusable, kUnusableViews);
    if (config_) account_.use(folder_ / kBenchmarkConfig, "parameter files");
    settle_range(pixels_.samples, options_.levels, report_);
  }
  void compare_config() {
    if (!config_) return;
    const ViewSize size = size_of(pixels_.samples);
    compare_size(*config_, size, report_);
    compare_grid(*config_, views_.whole_grid(), report_);
    info_.camera = read_camera(folder_, *config_, size, report_);
  }
  void read_truth(const Progress& progress) {
    const SidecarViews beside_views{views_,
                                    views_.files.front().parent_path(),
                                    pixels_.samples,
                                    info_.camera,
                                    options_.map_views(),
                                    options_.needs_truth};
    const SidecarNotes notes{account_, report_};
    truth_.field = read_benchmark_disparity(folder_, beside_views, notes, progress.part(0, 0.5));
    if (truth_.field.empty()) {
      // What other programs call it.
      SidecarMaps beside = read_sidecar_maps(beside_views, notes, progress.part(0.5, 1));
      truth_ = std::move(beside.truth);
      info_.camera = beside.camera;
      scene_.scribbles.labels = std::move(beside.label_infos);
    }
    correct_promise(truth_.field, info_.disparity_range, report_);
    if (!options_.needs_truth) return;
    tell_estimated();
    read_benchmark_masks(folder_, beside_views, notes, truth_);
    const auto stated = config_ ? config_->text("scene") : std::nullopt;
    truth_.stratified = stratified_scene(stated.value_or(info_.name));
  }
  /// What convert wrote in the place of truth says so.
  void tell_estimated() {
    const auto method = config_ ? config_->text(kEstimatedBy) : std::nullopt;
    if (!method || !truth_.has_disparity()) return;
    Provenance& estimated = truth_.estimated.emplace();
    estimated.method = *method;
    estimated.source = config_->text(kEstimatedFrom).value_or("");
    report_.warnings.push_back(
        fmt::format(finding_text("truth.estimated"), estimated_text(estimated)));
  }
  void assemble_scene(const Progress& progress) {
    SceneParts parts;
    parts.samples = std::move(pixels_.samples);
    parts.valid = std::move(pixels_.valid);
    parts.truth = std::move(truth_);
    parts.info = std::move(info_);
    parts.expected.reason = finding_text("order.of_benchmark");
    parts.files = account_.uses();
    assemble(std::move(parts), options_, scene_, progress);
  }

  const fs::path& folder_;
  const OpenOptions& options_;
  FileUsage account_;
  std::optional<ConfigFile> config_;
  std::optional<GridShape> given_;
  Scene scene_;
  ConventionReport& report_ = scene_.convention;
  LightFieldInfo info_;
  ViewFiles views_;
  LoadedViews pixels_;
  GroundTruth truth_;
};

}  // namespace

Scene read_benchmark(const fs::path& folder, const OpenOptions& options, const Progress& progress) {
  return BenchmarkReading(folder, options).read(progress);
}

fs::path find_benchmark(const fs::path& path, const OpenOptions& options) {
  const fs::path folder = scene_folder(path);
  const bool is_one =
      !folder.empty() && !wants_image_grid(options) && is_benchmark_folder(folder, options);
  return is_one ? folder : fs::path();
}

constexpr const char* kBenchmarkOptions[] = {"flip", "crop", "grid", "levels"};

std::string trimmed(const std::string& text) {
  const auto is_space = [](unsigned char c) { return std::isspace(c) != 0; };
  const auto begin = std::find_if_not(text.begin(), text.end(), is_space);
  const auto end = std::find_if_not(text.rbegin(), text.rend(), is_space).base();
  return begin < end ? std::string(begin, end) : std::string();
}

/// Without what a comment adds behind the value: "100.0 ; mm".
std::string without_comment(const std::string& value) {
  for (const std::size_t mark :
       {value.find(" ;"), value.find(" #"), value.find("\t;"), value.find("\t#")}) {
    if (mark != std::string::npos) return without_comment(trimmed(value.substr(0, mark)));
  }
  return value;
}

/// With a decimal point where a program of a language with decimal commas wrote the file.
std::string with_point(std::string value) {
  const std::size_t comma = value.find(',');
  const bool is_decimal = comma != std::string::npos && comma > 0 &&
                          value.find_first_not_of("+-0123456789eE,") == std::string::npos &&
                          value.find(',', comma + 1) == std::string::npos;
  if (is_decimal) value[comma] = '.';
  return value;
}

}  // namespace

Reader benchmark_reader() {
  return {.id = "benchmark2016",
          .name = "a scene of the 2016 benchmark",
          .options = kBenchmarkOptions,
          .find = find_benchmark,
          .read = read_benchmark,
          .probe = probe_benchmark};
}

ConfigFile::ConfigFile(const std::filesystem::path& path) {
  require_readable_file(path);
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos || line[0] == '#' || line[0] == ';') continue;
    const std::string value = trimmed(line.substr(equals + 1));
    values_[trimmed(line.substr(0, equals))] = without_comment(value);
  }
}

std::optional<std::string> ConfigFile::text(const std::string& key) const {
  const auto found = values_.find(key);
  return found == values_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<double> ConfigFile::number(const std::string& key) const {
  const auto value = text(key);
  return value ? parse_number(with_point(*value)) : std::nullopt;
}

std::vector<std::string> ConfigFile::values_without_number(
    std::initializer_list<const char*> keys) const {
  std::vector<std::string> values;
  for (const char* key : keys) {
    const auto value = text(key);
    if (value && !number(key)) values.push_back(std::string(key) + " is '" + *value + "'");
  }
  return values;
}

}  // namespace episcope::io
