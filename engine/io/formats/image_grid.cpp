// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/image_grid.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/light_field.h"
#include "engine/core/scene.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/image_header.h"
#include "engine/io/base/sample_range.h"
#include "engine/io/formats/archive_depth.h"
#include "engine/io/formats/mosaic_layout.h"
#include "engine/io/models/assemble_scene.h"
#include "engine/io/models/names/grid_names.h"
#include "engine/io/models/names/index_fields.h"
#include "engine/io/models/names/view_files.h"
#include "engine/io/models/names/view_folders.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/order/view_axes.h"
#include "engine/io/models/sidecar_maps/find_maps.h"
#include "engine/io/models/sidecar_maps/sidecar_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <sstream>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFew = 3;       ///< So many strays are no matter.
constexpr std::size_t kLookedAt = 5;  ///< Evenly spread over all.

bool looks_like_views(const fs::path& path, const LightField::Samples& samples) {
  try {
    const AnyImage image = decode_image(path);
    return std::visit(
        [&]<class T>(const ViewStack<T>& views) {
          const auto* same = std::get_if<Image<T>>(&image);
          return same != nullptr && same->height() == views.height() &&
                 same->width() == views.width() && same->channels() == views.channels();
        },
        samples);
  } catch (const IoError&) {
    return false;
  }
}

/// Warns where several images that were left out look like views: their names hold no word for
/// something else (label, depth, …), and those looked at, a few, have size, channels and sample
/// type of the views.
void warn_of_ignored_files(const std::vector<fs::path>& left_out,
                           const LightField::Samples& samples, ConventionReport& report) {
  std::vector<fs::path> strays = left_out;
  std::erase_if(strays, [](const fs::path& path) {
    return names_companions(path.stem().string()) || names_mosaics(path.stem().string());
  });
  if (strays.size() <= kFew) return;
  std::size_t similar = 0;
  for (std::size_t i = 0; i < kLookedAt; ++i) {
    similar += looks_like_views(strays[i * (strays.size() - 1) / (kLookedAt - 1)], samples) ? 1 : 0;
  }
  if (2 * similar <= kLookedAt) return;
  report.warnings.push_back(fmt::format(finding_text("views.other_names"), strays.size(),
                                        strays.front().filename().string()));
}

/// Drops names that differ from a view's in numbers only: a pattern that states one
/// of them leaves the others out on purpose.
std::vector<fs::path> without_other_numbers(std::vector<fs::path> left_out, const fs::path& view) {
  const std::string skeleton = split_name(view).skeleton;
  std::erase_if(left_out,
                [&](const fs::path& path) { return split_name(path).skeleton == skeleton; });
  return left_out;
}

fs::path find_grid(const fs::path& path, const OpenOptions& options) {
  const fs::path folder = scene_folder(path);
  if (folder.empty()) return {};
  const fs::path inside = views_folder(folder);
  const bool is_found = count_images(inside) > 0 || has_parts_with_poses(inside) ||
                        find_row_folders(inside, options) ||
                        find_view_folders(inside, options.pattern);
  return is_found ? folder : fs::path();
}

Scene read_grid(const fs::path& folder, const OpenOptions& options, const Progress& progress) {
  ImageGridExtras extras;
  extras.source = folder;
  return read_image_grid(views_folder(folder), options, progress, extras);
}

FileUsage account_of(const fs::path& source, const fs::path& folder, const ViewFiles& views,
                     const ImageGridExtras& extras) {
  FileUsage account(source);
  account.add_folder(folder);
  account.use(views.files, "views");
  account.leave_out(views.left_out, kViewsLeftOut);
  account.leave_out(views.unusable, kUnusableViews);
  for (const auto& [file, kind] : extras.files) account.use(file, kind);
  return account;
}

/// Of the cameras of a part of the views.
std::vector<CameraPosition> positions_of(const PartOfGrid& part,
                                         const std::vector<CameraPosition>& all) {
  std::vector<CameraPosition> positions;
  for (int i = 0; i < part.grid.count() && !all.empty(); ++i) {
    const ViewIndex view = part.in_whole(part.grid.view_at(i));
    positions.push_back(all[static_cast<std::size_t>(view.v * part.whole.u + view.u)]);
  }
  return positions;
}

/// Takes the distance of cameras side by side from poses; views are then not shifted.
void add_camera(const PosedViews& poses, const LightField::Samples& samples, CameraGrid& camera,
                FileUsage& account) {
  for (const fs::path& file : poses.files) {
    account.add_folder(file.parent_path());
    account.use(file, "pose files");
  }
  if (camera.is_known() || !(poses.focal_widths > 0)) return;
  const int width = std::visit([](const auto& stack) { return stack.width(); }, samples);
  camera.baseline = poses.step;
  camera.focal_length = poses.focal_widths * width;
}

/// Exchanges rows and columns of views where the motion between them says so without doubt, before
/// maps are judged by the views beside them. Nothing where that cannot be done yet.
std::optional<AxesFinding> settle_axes(ViewFiles& views, LoadedViews& pixels,
                                       std::vector<CameraPosition>& positions,
                                       const OpenOptions& options, const Progress& progress) {
  if (views.part || are_axes_stated(options)) return std::nullopt;
  const ViewAxes axes = find_view_axes(pixels.samples, progress);
  if (!axes.are_swapped()) return AxesFinding{{}, axes.are_unclear()};
  const GridShape stored = views.grid;
  swap_view_axes(pixels.samples);
  swap_view_axes(pixels.valid);
  swap_view_axes(positions, stored);
  const std::vector<fs::path> files = views.files;
  views.grid = {stored.u, stored.v};
  for (int i = 0; i < stored.count(); ++i) {
    const ViewIndex view = views.grid.view_at(i);
    views.files[static_cast<std::size_t>(i)] =
        files[static_cast<std::size_t>(view.u * stored.u + view.v)];
  }
  return AxesFinding{axes.evidence()};
}

/// "image grid (out_{row}_{col}.png, snake order)", with the folder inside of what was opened.
std::string format_of(const NamedGrid& grid, const fs::path& folder, const fs::path& source,
                      const OpenOptions& options) {
  std::string names;
  if (folder != source) names += folder.filename().string() + "/";
  names += grid.pattern;
  if (options.snake) names += ", snake order";
  return fmt::format(finding_text("format.grid"), names);
}

/// Throws IoError if pictures of a list are rather mosaics of views each.
void refuse_mosaics(const fs::path& folder, const ViewFiles& views) {
  const auto count = views.files.size();
  const auto mosaic = evident_mosaic(views.files.front());
  if (!mosaic || !evident_mosaic(views.files.back())) return;
  throw IoError(folder, fmt::format("each of the {} pictures looks like a mosaic of {} views ({}); "
                                    "open one of them, or give --grid 1x{} if they are the views",
                                    count, grid_text(mosaic->grid), mosaic->evidence, count));
}

/// Formats of float samples that are linear in light; their samples keep their scale.
bool is_linear_format(const fs::path& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".exr" || suffix == ".hdr";
}

constexpr const char* kGridOptions[] = {"flip", "crop", "pattern", "snake", "grid", "levels"};

}  // namespace

Reader image_grid_reader() {
  return {.id = "image_grid",
          .name = "a grid of images",
          .options = kGridOptions,
          .find = find_grid,
          .read = read_grid,
          .probe = probe_image_grid};
}

namespace {

// Reads a grid of images step by step.
class GridReading {
 public:
  GridReading(const fs::path& folder, const OpenOptions& options, const ImageGridExtras& extras)
      : folder_(folder),
        source_(extras.source.empty() ? folder : extras.source),
        options_(options),
        extras_(extras),
        grid_(name_grid(folder, options)) {}

  Scene read(const Progress& progress) {
    if (grid_.placed.is_list && !given_grid(options_)) refuse_mosaics(folder_, views_);
    evidence_ = settle_grid(folder_, grid_, options_, progress.part(0, 0.1));
    is_linear_ = is_linear_format(views_.files.front());
    begin_report();
    begin_info();
    progress.step("reading views");
    read_views(progress.part(0.1, 0.7));
    read_truth(progress);
    expect_order();
    assemble(std::move(parts_), options_, scene_, progress.part(0.8, 1));
    if (!evidence_.empty() && !report_.order_check.ends_with(evidence_)) {
      report_.order_check = evidence_ + "; " + report_.order_check;
    }
    return std::move(scene_);
  }

 private:
  void begin_report() {
    report_.format =
        extras_.format.empty() ? format_of(grid_, folder_, source_, options_) : extras_.format;
    if (is_linear_) report_.format += ", linear float samples";
    report_.units = "no depth in an image grid";
    report_.warnings = grid_.placed.warnings;
    if (const auto others = other_picture_folders(source_, folder_); !others.empty()) {
      report_.warnings.push_back(fmt::format(finding_text("views.other_folders"),
                                             folder_.filename().string(), joined(others, ", ")));
    }
  }
  void begin_info() {
    parts_.info = {scene_name(source_),
                   source_.string(),
                   extras_.camera,
                   extras_.disparity_range,
                   {.reader = extras_.reader, .options = {}},
                   grid_.placed.positions};
  }
  void read_views(const Progress& progress) {
    const auto show_center = [this](const Image<std::uint8_t>& center) {
      if (options_.on_center_view) options_.on_center_view(center, parts_.info, views_.grid);
    };
    UsableViews usable = load_usable_views(views_, show_center, progress);
    if (usable.kept) {
      parts_.info.positions = positions_of(*usable.kept, parts_.info.positions);
      views_ = std::move(usable.views);
      report_.warnings.push_back(std::move(usable.warning));
    }
    pixels_ = std::move(usable.pixels);
    if (!is_linear_ || !options_.levels.empty()) {
      settle_range(pixels_.samples, options_.levels, report_);
    }
  }
  void read_truth(const Progress& progress) {
    FileUsage account = account_of(source_, folder_, views_, extras_);
    CameraGrid& camera = parts_.info.camera;
    if (grid_.poses.are_used()) add_camera(grid_.poses, pixels_.samples, camera, account);
    if (extras_.read_truth) {
      parts_.truth.field = extras_.read_truth(pixels_.samples, camera, report_);
    } else {
      progress.step("checking the order of views");
      parts_.axes =
          settle_axes(views_, pixels_, parts_.info.positions, options_, progress.part(0.7, 0.75));
      SidecarMaps beside =
          read_sidecar_maps({views_, folder_, pixels_.samples, camera, options_.map_views(),
                             options_.needs_truth, grid_.poses.are_used()},
                            {account, report_}, progress.part(0.75, 0.8));
      parts_.truth = std::move(beside.truth);
      parts_.expected.is_truth_sign_assumed = beside.is_sign_assumed;
      camera = beside.camera;
      scene_.scribbles.labels = std::move(beside.label_infos);
    }
    parts_.files = account.uses();
  }
  void expect_order() {
    if (!options_.pattern.empty()) {
      grid_.left_out = without_other_numbers(std::move(grid_.left_out), views_.files.front());
    }
    warn_of_ignored_files(grid_.left_out, pixels_.samples, report_);
    parts_.samples = std::move(pixels_.samples);
    parts_.valid = std::move(pixels_.valid);
    parts_.expected.reason = evidence_.empty() ? finding_text("order.of_names") : evidence_;
    if (grid_.poses.are_used()) parts_.expected.reason = finding_text("order.of_poses");
    parts_.expected.is_of_poses = grid_.poses.are_used();
  }

  const fs::path& folder_;
  const fs::path& source_;
  const OpenOptions& options_;
  const ImageGridExtras& extras_;
  NamedGrid grid_;
  ViewFiles& views_ = grid_.placed.views;
  std::string evidence_;  // of the grid; empty if names tell it
  bool is_linear_ = false;
  LoadedViews pixels_;
  SceneParts parts_;
  Scene scene_;
  ConventionReport& report_ = scene_.convention;
};

}  // namespace

Scene read_image_grid(const fs::path& folder, const OpenOptions& options, const Progress& progress,
                      const ImageGridExtras& extras) {
  return GridReading(folder, options, extras).read(progress);
}

namespace {

using PixelSize = std::pair<int, int>;

/// Nothing for a file that cannot be decoded.
std::optional<PixelSize> size_of(const std::filesystem::path& file) {
  try {
    const ImageHeader header = read_image_header(file);
    return PixelSize{header.height, header.width};
  } catch (const IoError&) {
    return std::nullopt;
  }
}

/// Whether the center and two corners are of one size.
bool look_alike(const ViewFiles& views) {
  const ViewIndex center = views.grid.center();
  const auto size = size_of(views.file(center));
  return size && size == size_of(views.files.front()) && size == size_of(views.files.back());
}

/// The views without those whose headers differ from most of the others. Throws IoError if too few
/// are left.
ViewFiles those_alike(const ViewFiles& views) {
  std::vector<std::optional<PixelSize>> sizes;
  for (const auto& file : views.files) sizes.push_back(size_of(file));
  const std::optional<PixelSize> usual = majority(sizes);
  std::vector<UnusableView> unusable;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (!usual || sizes[i] != usual) unusable.push_back({static_cast<int>(i), {}});
  }
  auto left = without_views(views, unusable);
  if (left) return std::move(left->views);
  throw IoError(views.files.front().parent_path(),
                "the views differ in size, or cannot be decoded; all views must match");
}

/// "disparity of all views" of the largest set of a kind; empty if there is none.
std::string maps_text(const FoundMapSets& maps, MapKind kind, const char* name) {
  std::size_t most = 0;
  for (const MapSet& set : maps.sets) {
    if (set.kind == kind) most = std::max(most, set.entries.size());
  }
  if (most == 0) return {};
  return std::string(name) + (most > 1 ? " of all views" : " of one view");
}

}  // namespace

SceneProbe probe_views(const ViewFiles& given) {
  const ViewFiles views = look_alike(given) ? given : those_alike(given);
  const ImageHeader header = read_image_header(views.file(views.grid.center()));
  const bool is_turned = is_quarter_turn(views.orientation);
  return {.grid = views.grid,
          .height = is_turned ? header.width : header.height,
          .width = is_turned ? header.height : header.width,
          .channels = header.channels,
          .sample_type = header.sample_type};
}

SceneProbe probe_image_grid(const std::filesystem::path& folder, const OpenOptions& options) {
  const std::filesystem::path inside = views_folder(folder);
  PlacedViews placed = name_grid(inside, options).placed;
  SceneProbe probe = probe_views(placed.views);
  if (placed.is_list) {
    probe.list = placed.views.grid.count();
    probe.grid = given_grid(options).value_or(GridShape());
  }
  const FoundMapSets maps = find_maps(placed.views, inside);
  probe.truth = maps_text(maps, MapKind::Disparity, "disparity");
  if (probe.truth.empty()) probe.truth = maps_text(maps, MapKind::Depth, "depth");
  probe.labels = maps_text(maps, MapKind::Labels, "labels");
  return probe;
}

namespace {

CameraGrid camera_of(const ExcerptAttributes& attributes) {
  const auto number = [&](const char* name) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? 0 : found->second;
  };
  CameraGrid camera;
  camera.baseline = number("dH");
  camera.focal_length = number("focalLength");
  camera.shift = number("shift");
  return camera;
}

ViewStack<float> read_depth(const fs::path& path, int height, int width, ViewIndex center) {
  require_openable_file(path);  // any bytes may be samples
  ViewStack<float> depth({1, 1}, height, width, 1, center);
  const std::uintmax_t bytes = fs::file_size(path);
  if (bytes != depth.size() * sizeof(float)) {
    throw IoError(path, fmt::format("the file has {} bytes, but {} are expected for {}×{} float "
                                    "samples; copy it again or remove it",
                                    bytes, depth.size() * sizeof(float), width, height));
  }
  std::ifstream in(path, std::ios::binary);
  in.read(reinterpret_cast<char*>(depth.data()), static_cast<std::streamsize>(bytes));
  if constexpr (std::endian::native == std::endian::big) {
    std::transform(depth.data(), depth.data() + depth.size(), depth.data(), [](float sample) {
      return std::bit_cast<float>(__builtin_bswap32(std::bit_cast<std::uint32_t>(sample)));
    });
  }
  return depth;
}

ViewStack<std::uint8_t> read_excerpt_mask(const fs::path& path, int height, int width,
                                          ViewIndex center) {
  if (!is_there(path)) return {};
  const Image<std::int32_t> numbers = decode_numbers(path);
  if (numbers.height() != height || numbers.width() != width) {
    throw IoError(
        path,
        fmt::format("the mask has {}×{} px, but the views have {}×{} px; remove or replace it",
                    numbers.width(), numbers.height(), width, height));
  }
  ViewStack<std::uint8_t> mask({1, 1}, height, width, 1, center);
  std::transform(numbers.begin(), numbers.end(), mask.data(),
                 [](std::int32_t value) { return static_cast<std::uint8_t>(value != 0); });
  return mask;
}

bool is_excerpt_folder(const fs::path& folder) {
  return is_there(folder / "depth.bin") && is_there(folder / "attributes.dat") &&
         fs::is_directory(folder / "lf");
}

Scene read_excerpt(const fs::path& folder, const OpenOptions& options, const Progress& progress) {
  const auto attributes = read_excerpt_attributes(folder / "attributes.dat");
  ImageGridExtras extras;
  extras.reader = "excerpt";
  extras.format = "archive excerpt (lf, depth.bin)";
  extras.source = folder;
  extras.camera = camera_of(attributes);
  const auto min = attributes.find("min_disp");
  const auto max = attributes.find("max_disp");
  if (min != attributes.end() && max != attributes.end() && min->second < max->second) {
    extras.disparity_range = Interval{min->second, max->second};
  }
  extras.files = {{folder / "attributes.dat", "camera attributes"},
                  {folder / "depth.bin", "depth of the center view"}};
  if (is_there(folder / "mask.png")) extras.files.emplace_back(folder / "mask.png", "mask");
  extras.read_truth = [&](const LightField::Samples& samples, CameraGrid& camera,
                          ConventionReport& report) {
    if (!camera.is_known()) {
      throw IoError(folder / "attributes.dat",
                    "dH and focalLength are missing here; add them or open the folder lf alone");
    }
    return std::visit(
        [&](const auto& stack) {
          const ViewIndex center = stack.grid().center();
          DepthMaps maps{
              "depth.bin", read_depth(folder / "depth.bin", stack.height(), stack.width(), center),
              read_excerpt_mask(folder / "mask.png", stack.height(), stack.width(), center)};
          camera = settle_units(maps, samples, camera, options.units, report);
          return disparity_from_depth(std::move(maps), camera, report, Progress(1));
        },
        samples);
  };
  return read_image_grid(folder / "lf", options, progress, extras);
}

SceneProbe probe_excerpt(const fs::path& folder, const OpenOptions& options) {
  SceneProbe probe = probe_image_grid(folder, options);
  probe.truth = "depth of the center view";
  return probe;
}

fs::path find_excerpt(const fs::path& path, const OpenOptions& options) {
  const fs::path folder = scene_folder(path);
  const bool is_one = !folder.empty() && !wants_image_grid(options) && is_excerpt_folder(folder);
  return is_one ? folder : fs::path();
}

constexpr const char* kExcerptOptions[] = {"flip",  "crop", "units", "pattern",
                                           "snake", "grid", "levels"};

}  // namespace

Reader excerpt_reader() {
  return {.id = "excerpt",
          .name = "an excerpt of the 2013 archive",
          .options = kExcerptOptions,
          .find = find_excerpt,
          .read = read_excerpt,
          .probe = probe_excerpt};
}

ExcerptAttributes read_excerpt_attributes(const std::filesystem::path& path) {
  require_readable_file(path);
  std::ifstream in(path);
  ExcerptAttributes attributes;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string value;
    std::string name;
    words >> value >> name;
    const auto number = parse_number(value);
    if (number && name.starts_with("//")) attributes[name.substr(2)] = *number;
  }
  return attributes;
}

}  // namespace episcope::io
