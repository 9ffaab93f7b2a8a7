// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/mosaic_reader.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/image.h"
#include "engine/core/scene.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/image_header.h"
#include "engine/io/base/sample_range.h"
#include "engine/io/formats/mosaic_layout.h"
#include "engine/io/models/array_file.h"
#include "engine/io/models/assemble_scene.h"
#include "engine/io/models/load_views.h"
#include "engine/io/models/names/grid_names.h"
#include "engine/io/models/names/view_folders.h"
#include "engine/io/models/sidecar_maps/map_name.h"
#include "engine/io/models/sidecar_maps/scene_files.h"
#include "engine/io/models/sidecar_maps/sidecar_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <vector>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestMosaicSide = 1'000'000;  ///< In px.

Mosaic kind_of_name(const std::string& name) {
  std::istringstream words(lower_case(last_name(name)));
  for (std::string word; std::getline(words, word, '_');) {
    if (word == "sai") return Mosaic::Views;
    if (word == "macpi") return Mosaic::Lenslets;
  }
  return Mosaic::Auto;
}

bool can_be_picture(const Hdf5Dataset& dataset) {
  return dataset.shape.size() == 2 && dataset.type != Hdf5Type::Other &&
         std::ranges::all_of(dataset.shape, [](std::size_t side) {
           return side > 1 && side <= kLongestMosaicSide;
         });
}

std::size_t area(const Hdf5Dataset& dataset) {
  return dataset.shape[0] * dataset.shape[1];
}

bool asks_for_mosaic(const OpenOptions& options) {
  return options.mosaic != Mosaic::Auto || options.lenslet > 0 || !options.grid.empty();
}

std::optional<Hdf5Dataset> choose(const Hdf5Input& file, const OpenOptions& options) {
  std::optional<Hdf5Dataset> best;
  for (const Hdf5Dataset& each : file.datasets()) {
    if (!can_be_picture(each)) continue;
    const bool has_name = kind_of_name(each.name) != Mosaic::Auto;
    const bool is_meant = options.dataset.empty() ? has_name : each.name == options.dataset;
    if (!is_meant || !(has_name || asks_for_mosaic(options))) continue;
    if (!best || area(each) > area(*best)) best = each;
  }
  return best;
}

/// Only a grid that divides the picture: a number of that name may mean something else.
GridShape stated_grid(const Hdf5Input& file, const MosaicDataset& dataset) {
  constexpr double kMostGridSide = 1000;
  const std::size_t height = dataset.shape[dataset.is_transposed ? 1 : 0];
  const std::size_t width = dataset.shape[dataset.is_transposed ? 0 : 1];
  for (const std::string& object : {dataset.name, std::string("/")}) {
    for (const char* name : {"angRes", "ang_res", "grid"}) {
      const std::vector<double> sides = file.numbers(object, name);
      const bool is_grid =
          (sides.size() == 1 || sides.size() == 2) && std::ranges::all_of(sides, [](double side) {
            return side >= 1 && side <= kMostGridSide;
          });
      if (!is_grid) continue;
      const GridShape grid{static_cast<int>(sides.front()), static_cast<int>(sides.back())};
      const auto divides = [](int views, std::size_t side) {
        return side % static_cast<std::size_t>(views) == 0;
      };
      if (divides(grid.v, height) && divides(grid.u, width)) return grid;
    }
  }
  return {0, 0};
}

template <class T>
AnyImage read_as(const Hdf5Input& file, const MosaicDataset& dataset) {
  require_view_memory(file.path(), static_cast<double>(dataset.shape[0]) *
                                       static_cast<double>(dataset.shape[1]) * sizeof(T));
  Image<T> image(static_cast<int>(dataset.shape[0]), static_cast<int>(dataset.shape[1]));
  file.read(dataset.name, {Hdf5Shape(2, 0), dataset.shape}, image.data());
  if (dataset.is_transposed) return transposed(image);
  return image;
}

}  // namespace

std::optional<MosaicDataset> find_mosaic_dataset(const fs::path& path, const OpenOptions& options) {
  if (!has_hdf5_signature(path)) return std::nullopt;
  const Hdf5Input file(path);
  if (options.dataset.empty() && (file.has("LF") || file.has("estimate"))) return std::nullopt;
  const auto chosen = choose(file, options);
  if (!chosen) return std::nullopt;
  MosaicDataset dataset{chosen->name, chosen->shape, chosen->type};
  dataset.kind = kind_of_name(dataset.name);
  dataset.is_transposed = dataset.kind != Mosaic::Auto;
  dataset.grid = stated_grid(file, dataset);
  return dataset;
}

namespace {

/// The picture `[y][x]`. Throws IoError.
AnyImage read_mosaic_dataset(const fs::path& path, const MosaicDataset& dataset) {
  const Hdf5Input file(path);
  static_cast<void>(file.dataset(dataset.name));  // throws if the file cannot hold as much
  if (dataset.type == Hdf5Type::UInt8) return read_as<std::uint8_t>(file, dataset);
  if (dataset.type == Hdf5Type::UInt16) return read_as<std::uint16_t>(file, dataset);
  return read_as<float>(file, dataset);
}

/// What became of all datasets of the file.
std::vector<FileUse> uses_beside(const fs::path& path, const MosaicDataset& dataset) {
  std::vector<FileUse> uses{{"mosaics", 1, dataset.name, true}};
  for (const Hdf5Dataset& other : Hdf5Input(path).datasets()) {
    if (other.name == dataset.name) continue;
    uses.push_back({fmt::format(finding_text("dataset.array"), shape_text(other.shape)), 1,
                    other.name, false});
  }
  return uses;
}

/// Beside so many images a mosaic is a by-product, as one made from a folder of views.
constexpr std::size_t kMostOthers = 3;
/// As many headers are read before an image counts as one among many.
constexpr std::size_t kMostSiblings = 64;

bool wants_mosaic(const OpenOptions& options) {
  return options.mosaic != Mosaic::Auto || options.lenslet > 0;
}

/// Whether a folder is a light field of another form. Any image makes its folder a grid of images:
/// that counts only if the views are in a folder inside.
bool is_other_form(const fs::path& folder, const OpenOptions& options) {
  if (views_folder(folder) != folder) return true;
  return std::ranges::any_of(readers(), [&](const Reader& reader) {
    const std::string_view id = reader.id;
    return id != "mosaic" && id != "sequence" && id != "image_grid" &&
           !reader.find(folder, options).empty();
  });
}

/// Whether an image is larger than all others of its folder.
bool is_largest(const fs::path& path, const std::vector<fs::path>& images) {
  if (images.size() == 1) return true;
  const auto size = image_size(path);
  if (!size || images.size() > kMostSiblings) return false;
  return std::ranges::all_of(images, [&](const fs::path& other) {
    if (other.filename() == path.filename()) return true;
    const auto its = image_size(other);
    return its && its->area() < size->area();
  });
}

/// Whether names of a folder tell rows and columns of views.
bool are_views_named(const fs::path& folder, const OpenOptions& options) {
  try {
    return !name_grid(folder, options).placed.is_list;
  } catch (const IoError&) {
    return false;
  }
}

fs::path find_by_file(const fs::path& path, const OpenOptions& options) {
  if (!is_image_name(path)) return find_mosaic_dataset(path, options) ? path : fs::path();
  if (wants_mosaic(options) || mosaic_name(path) != MosaicName::Plain) return path;
  const fs::path folder = scene_folder(path);
  if (is_other_form(folder, options)) return {};
  const bool is_one = is_largest(path, list_images(folder)) ||
                      (!are_views_named(folder, options) && evident_mosaic(path));
  return is_one ? path : fs::path();
}

fs::path find_in_folder(const fs::path& folder, const OpenOptions& options) {
  const std::vector<fs::path> images = list_images(folder);
  std::vector<fs::path> found;
  std::ranges::copy_if(images, std::back_inserter(found), [](const fs::path& image) {
    return mosaic_name(image) != MosaicName::Plain;
  });
  const bool is_asked = wants_mosaic(options);
  if (found.empty() && (is_asked || images.size() == 1)) found = images;
  if (found.empty()) return {};
  const std::size_t others = images.size() - found.size();
  if (!is_asked && (others > kMostOthers * found.size() || is_other_form(folder, options))) {
    return {};
  }
  if (found.size() == 1) return found.front();
  throw IoError(
      folder, fmt::format("the folder holds {} light fields, each in one image ({}, {}{}); "
                          "open one of them, or list them with episcope-cli list",
                          found.size(), found[0].filename().string(), found[1].filename().string(),
                          found.size() > 2 ? ", …" : ""));
}

/// The picture that holds all views, if `path` is one, an HDF5 file with one
/// (`find_mosaic_dataset`), or a folder with one: by its name, because
/// options ask for a mosaic, or because no other image of the folder is as large, while the folder
/// has no other form. Reads headers of images only. Throws IoError for a folder with several.
fs::path find_mosaic(const fs::path& path, const OpenOptions& options) {
  if (wants_image_grid(options)) return {};
  return fs::is_directory(path) ? find_in_folder(path, options) : find_by_file(path, options);
}

/// Whether no other image of its folder holds all views of another light field.
bool is_only_mosaic(const fs::path& picture) {
  const std::vector<fs::path> images = list_images(scene_folder(picture));
  return std::ranges::all_of(images, [&](const fs::path& other) {
    return other.filename() == picture.filename() || mosaic_name(other) == MosaicName::Plain;
  });
}

/// Whether `other` is as likely a picture of all views: by its name, or because it has the same
/// size.
bool is_alike(const std::filesystem::path& other, const std::filesystem::path& picture) {
  if (mosaic_name(other) != MosaicName::Plain) return true;
  if (map_kind(other.stem().string())) return false;
  const auto size = image_size(other), own = image_size(picture);
  return size && own && size->area() == own->area();
}

/// Which files of a folder belong to a picture of all views: those named after its scene
/// ("flower_depth.png" to "flower_eslf.png", and not to "flower_2_eslf.png"), and those that name
/// no scene if no other picture there is a light field (`is_only_mosaic`).
SceneFiles maps_of(const std::filesystem::path& picture) {
  std::vector<std::string> others = light_fields_beside(picture);
  for (const std::filesystem::path& other : list_images(scene_folder(picture))) {
    if (other.filename() == picture.filename() || !is_alike(other, picture)) continue;
    others.push_back(scene_of_mosaic(other));
  }
  return {{scene_of_mosaic(picture)}, std::move(others), is_only_mosaic(picture)};
}

std::string format_of(const MosaicLayout& layout) {
  const std::string grid = grid_text(layout.grid);
  switch (layout.kind) {
    case Mosaic::Quilt:
      return fmt::format(finding_text("format.quilt"), grid_text(layout.tiles), layout.evidence);
    case Mosaic::ViewsUp:
      return fmt::format(finding_text("format.mosaic_up"), grid, layout.evidence);
    case Mosaic::Lenslets:
      return fmt::format(finding_text("format.lenslets"), grid, layout.evidence);
    default:
      return fmt::format(finding_text("format.mosaic"), grid, layout.evidence);
  }
}

/// Of sizes that the grid does not divide.
void report_remainder(const AnyImage& picture, const MosaicLayout& layout,
                      ConventionReport& report) {
  const auto [height, width] = std::visit(
      [](const auto& image) { return std::pair(image.height(), image.width()); }, picture);
  const int rows = height - layout.height * layout.tiles.v;
  const int columns = width - layout.width * layout.tiles.u;
  if (rows == 0 && columns == 0) return;
  report.warnings.push_back(fmt::format(finding_text("views.remainder"), width, height,
                                        grid_text(layout.grid), columns, rows));
}

std::vector<FileUse> account_of(const fs::path& path) {
  // Mosaics beside it are light fields of their own.
  FileUsage account(is_only_mosaic(path) ? scene_folder(path) : path);
  account.use(path, "mosaics");
  return account.uses();
}

/// Truth in the folder of a mosaic, and what becomes of the files there.
void add_beside(const fs::path& path, const OpenOptions& options, SceneParts& parts, Scene& scene,
                const Progress& progress) {
  const bool is_itself_a_map = map_kind(path.stem().string()).has_value();
  if (is_itself_a_map) return;
  const fs::path folder = scene_folder(path);
  FileUsage account(is_only_mosaic(path) ? folder : path);
  account.use(path, "mosaics");
  const ViewFiles views{grid_of(parts.samples), {}};
  SidecarMaps beside = read_sidecar_maps({.files = views,
                                          .folder = folder,
                                          .samples = parts.samples,
                                          .camera = parts.info.camera,
                                          .map_views = options.map_views(),
                                          .needs_truth = options.needs_truth,
                                          .own = maps_of(path)},
                                         {account, scene.convention}, progress);
  parts.truth = std::move(beside.truth);
  parts.expected.is_truth_sign_assumed = beside.is_sign_assumed;
  parts.info.camera = beside.camera;
  scene.scribbles.labels = std::move(beside.label_infos);
  parts.files = account.uses();
}

/// A picture of all views, and where from.
struct MosaicPicture {
  AnyImage picture;
  Image<std::uint8_t> seen;  ///< As in SeenImage.
  MosaicLayout layout;
  std::string origin;  ///< For the report; empty for an image.
  std::vector<FileUse> files;
};

bool may_have_gaps(const fs::path& path, const OpenOptions& options) {
  const MosaicName name = mosaic_name(path);
  return (options.mosaic == Mosaic::Auto || options.mosaic == Mosaic::Views) &&
         options.lenslet == 0 && (name == MosaicName::Plain || name == MosaicName::Mosaic);
}

/// Of lenslets that are no whole number of pixels apart. Throws IoError.
void make_lenslets_whole(SeenImage& picture, const fs::path& path, const OpenOptions& options) {
  if (!has_fraction(options.lenslet)) return;
  constexpr double kSmallestPitch = 2;
  const auto [height, width] = std::visit(
      [](const auto& image) { return std::pair(image.height(), image.width()); }, picture.image);
  if (options.lenslet < kSmallestPitch || std::min(height, width) < 2 * options.lenslet) {
    throw IoError(path, fmt::format("a picture of {}×{} px is no light field of lenslets that are "
                                    "{:g} px apart; correct --lenslet",
                                    width, height, options.lenslet));
  }
  picture = with_whole_lenslets(picture, options.lenslet);
}

/// Of views side by side, gaps between them are cut out of the picture.
MosaicLayout find_layout(AnyImage& picture, Image<std::uint8_t>& seen, const fs::path& path,
                         const OpenOptions& options) {
  if (may_have_gaps(path, options)) {
    const auto sheet = find_contact_sheet(picture);
    const auto given = given_grid(options);
    if (sheet && (!given || *given == sheet->grid())) {
      AnyImage tiles = without_gaps(picture, *sheet);
      MosaicLayout layout = find_mosaic_layout(tiles, path, options);
      if (layout.grid == sheet->grid() && layout.kind == Mosaic::Views) {
        picture = std::move(tiles);
        if (!seen.empty()) seen = std::get<Image<std::uint8_t>>(without_gaps(seen, *sheet));
        layout.evidence += "; " + sheet->text();
        return layout;
      }
    }
  }
  return find_mosaic_layout(picture, path, options);
}

MosaicPicture read_from_image(const fs::path& path, const OpenOptions& options) {
  SeenImage decoded = decode_seen(path);
  make_lenslets_whole(decoded, path, options);
  MosaicLayout layout = find_layout(decoded.image, decoded.seen, path, options);
  return {
      std::move(decoded.image), std::move(decoded.seen), std::move(layout), {}, account_of(path)};
}

/// What the dataset says is as if options said it, unless they do.
MosaicPicture read_from_dataset(const fs::path& path, const MosaicDataset& dataset,
                                OpenOptions options) {
  SeenImage read{read_mosaic_dataset(path, dataset)};
  make_lenslets_whole(read, path, options);
  AnyImage picture = std::move(read.image);
  if (options.mosaic == Mosaic::Auto && options.lenslet == 0) options.mosaic = dataset.kind;
  const bool is_stated = options.grid.empty() && options.lenslet == 0 && dataset.grid.count() > 0;
  if (is_stated) options.grid = fmt::format("{}x{}", dataset.grid.v, dataset.grid.u);
  MosaicLayout layout = find_mosaic_layout(picture, path, options, "the dataset " + dataset.name);
  if (is_stated) layout.evidence = "as an attribute says";
  const char* order = dataset.is_transposed ? ", stored by columns" : "";
  return {std::move(picture),
          {},
          std::move(layout),
          fmt::format(", HDF5 dataset {}{}", dataset.name, order),
          uses_beside(path, dataset)};
}

MosaicPicture read_picture(const fs::path& path, const OpenOptions& options) {
  const auto dataset = find_mosaic_dataset(path, options);
  return dataset ? read_from_dataset(path, *dataset, options) : read_from_image(path, options);
}

Scene read_mosaic(const fs::path& path, const OpenOptions& options, const Progress& progress) {
  progress.step("reading the picture");
  MosaicPicture read = read_picture(path, options);
  const AnyImage& picture = read.picture;
  const MosaicLayout& layout = read.layout;
  progress.check();
  LightFieldInfo info{
      scene_name(path), path.string(), {}, std::nullopt, {.reader = "mosaic", .options = {}}};
  if (options.on_center_view) {
    const AnyImage center = mosaic_view(picture, layout, layout.grid.center());
    std::visit(
        [&](const auto& view) {
          options.on_center_view(preview_rgb(view.view()), info, layout.grid);
        },
        center);
  }
  Scene scene;
  ConventionReport& report = scene.convention;
  report.format = format_of(layout) + read.origin;
  report.units = "no depth in a mosaic";
  report_remainder(picture, layout, report);
  progress.step("splitting the picture into views");
  LightField::Samples samples = split_mosaic(picture, layout, progress.part(0.5, 0.75));
  settle_range(samples, options.levels, report);
  SceneParts parts;
  parts.samples = std::move(samples);
  if (!read.seen.empty()) {
    parts.valid = std::get<ViewStack<std::uint8_t>>(
        split_mosaic(std::move(read.seen), layout, progress.part(0.75, 0.76)));
  }
  parts.info = std::move(info);
  parts.expected.reason = finding_text("order.of_mosaics");
  parts.files = std::move(read.files);
  if (read.origin.empty()) add_beside(path, options, parts, scene, progress.part(0.75, 0.8));
  assemble(std::move(parts), options, scene, progress.part(0.8, 1));
  return scene;
}

SceneProbe probe_dataset(const MosaicDataset& dataset, const OpenOptions& options) {
  const GridShape grid = given_grid(options).value_or(dataset.grid);
  if (grid.count() == 0) return {};
  const auto side = [&](std::size_t axis) { return static_cast<int>(dataset.shape[axis]); };
  SceneProbe probe{.grid = grid,
                   .height = side(dataset.is_transposed ? 1 : 0) / grid.v,
                   .width = side(dataset.is_transposed ? 0 : 1) / grid.u,
                   .channels = 1};
  if (dataset.type == Hdf5Type::UInt8) probe.sample_type = SampleType::UInt8;
  if (dataset.type == Hdf5Type::Float) probe.sample_type = SampleType::Float32;
  return probe;
}

/// Lenslets show their period in a part of the picture, views side by side only in the whole.
SceneProbe probe_mosaic(const fs::path& path, const OpenOptions& options) {
  constexpr int kRows = 640;
  if (const auto dataset = find_mosaic_dataset(path, options)) {
    return probe_dataset(*dataset, options);
  }
  const auto header = stated_image_header(path);
  if (!header || !has_png_signature(path)) return {};
  const MosaicName name = mosaic_name(path);
  const bool is_named = name == MosaicName::Eslf || name == MosaicName::Lenslets;
  if (!is_named || has_fraction(options.lenslet)) return {};
  const auto grid = find_lenslets(decode_png_top(path, kRows), header->height, path, options);
  if (!grid) return {};
  return {.grid = *grid,
          .height = header->height / grid->v,
          .width = header->width / grid->u,
          .channels = header->channels,
          .sample_type = header->sample_type};
}

constexpr const char* kMosaicOptions[] = {"flip",    "grid",    "crop",  "mosaic",
                                          "lenslet", "dataset", "levels"};

}  // namespace

Reader mosaic_reader() {
  return {.id = "mosaic",
          .name = "a mosaic of views",
          .options = kMosaicOptions,
          .find = find_mosaic,
          .read = read_mosaic,
          .probe = probe_mosaic};
}

}  // namespace episcope::io
