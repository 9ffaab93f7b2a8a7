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

Scene read_image_grid(const fs::path& folder, const OpenOptions& options, const Progress& progress,
                      const ImageGridExtras& extras) {
  NamedGrid grid = name_grid(folder, options);
  if (grid.placed.is_list && !given_grid(options)) refuse_mosaics(folder, grid.placed.views);
  const std::string evidence = settle_grid(folder, grid, options, progress.part(0, 0.1));
  ViewFiles& views = grid.placed.views;
  const bool is_linear = is_linear_format(views.files.front());
  Scene scene;
  ConventionReport& report = scene.convention;
  const fs::path& source = extras.source.empty() ? folder : extras.source;
  report.format = extras.format.empty() ? format_of(grid, folder, source, options) : extras.format;
  if (is_linear) report.format += ", linear float samples";
  report.units = "no depth in an image grid";
  report.warnings = grid.placed.warnings;
  if (const auto others = other_picture_folders(source, folder); !others.empty()) {
    report.warnings.push_back(fmt::format(finding_text("views.other_folders"),
                                          folder.filename().string(), joined(others, ", ")));
  }
  LightFieldInfo info{scene_name(source),
                      source.string(),
                      extras.camera,
                      extras.disparity_range,
                      {.reader = extras.reader, .options = {}},
                      grid.placed.positions};
  progress.step("reading views");
  UsableViews usable = load_usable_views(
      views,
      [&](const Image<std::uint8_t>& center) {
        if (options.on_center_view) options.on_center_view(center, info, views.grid);
      },
      progress.part(0.1, 0.7));
  LightField::Samples& samples = usable.pixels.samples;
  if (usable.kept) {
    info.positions = positions_of(*usable.kept, info.positions);
    views = std::move(usable.views);
    report.warnings.push_back(std::move(usable.warning));
  }
  if (!is_linear || !options.levels.empty()) settle_range(samples, options.levels, report);
  FileUsage account = account_of(source, folder, views, extras);
  if (grid.poses.are_used()) add_camera(grid.poses, samples, info.camera, account);
  SceneParts parts;
  if (extras.read_truth) {
    parts.truth.field = extras.read_truth(samples, info.camera, report);
  } else {
    progress.step("checking the order of views");
    parts.axes =
        settle_axes(views, usable.pixels, info.positions, options, progress.part(0.7, 0.75));
    SidecarMaps beside =
        read_sidecar_maps({views, folder, samples, info.camera, options.map_views(),
                           options.needs_truth, grid.poses.are_used()},
                          {account, report}, progress.part(0.75, 0.8));
    parts.truth = std::move(beside.truth);
    parts.expected.is_truth_sign_assumed = beside.is_sign_assumed;
    info.camera = beside.camera;
    scene.scribbles.labels = std::move(beside.label_infos);
  }
  if (!options.pattern.empty()) {
    grid.left_out = without_other_numbers(std::move(grid.left_out), views.files.front());
  }
  warn_of_ignored_files(grid.left_out, samples, report);
  parts.samples = std::move(samples);
  parts.valid = std::move(usable.pixels.valid);
  parts.info = std::move(info);
  parts.expected.reason = evidence.empty() ? finding_text("order.of_names") : evidence;
  if (grid.poses.are_used()) parts.expected.reason = finding_text("order.of_poses");
  parts.expected.is_of_poses = grid.poses.are_used();
  parts.files = account.uses();
  assemble(std::move(parts), options, scene, progress.part(0.8, 1));
  if (!evidence.empty() && !report.order_check.ends_with(evidence)) {
    report.order_check = evidence + "; " + report.order_check;
  }
  return scene;
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

void add_maps_beside(const FoundMapSets& maps, SceneProbe& probe) {
  if (probe.truth.empty()) probe.truth = maps_text(maps, MapKind::Disparity, "disparity");
  if (probe.truth.empty()) probe.truth = maps_text(maps, MapKind::Depth, "depth");
  if (probe.labels.empty()) probe.labels = maps_text(maps, MapKind::Labels, "labels");
}

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
  add_maps_beside(find_maps(placed.views, inside), probe);
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
