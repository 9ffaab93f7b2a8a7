// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/mosaic/mosaic_reader.h"

#include "engine/io/beside/beside.h"
#include "engine/io/grid/decode_png.h"
#include "engine/io/grid/image_header.h"
#include "engine/io/maps/sample_range.h"
#include "engine/io/mosaic/find_mosaic.h"
#include "engine/io/mosaic/mosaic_dataset.h"
#include "engine/io/mosaic/mosaic_name.h"
#include "engine/io/mosaic/own_files.h"
#include "engine/io/mosaic/split_mosaic.h"
#include "engine/io/mosaic/tile_gaps.h"
#include "engine/io/open/assemble_scene.h"
#include "engine/io/open/center_preview.h"
#include "engine/io/open/folder_account.h"
#include "engine/io/open/grid_option.h"
#include "engine/io/open/scene_folder.h"
#include "engine/io/open/scene_name.h"

#include <fmt/format.h>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

std::string format_of(const MosaicLayout& layout) {
  const std::string grid = grid_text(layout.grid);
  return layout.kind == Mosaic::Lenslets
             ? fmt::format("mosaic of lenslets of {} px ({})", grid, layout.evidence)
             : fmt::format("mosaic of {} views side by side ({})", grid, layout.evidence);
}

/// Of sizes that the grid does not divide.
void report_remainder(const AnyImage& picture, const MosaicLayout& layout,
                      ConventionReport& report) {
  const auto [height, width] = std::visit(
      [](const auto& image) { return std::pair(image.height(), image.width()); }, picture);
  const int rows = height - layout.height * layout.grid.v;
  const int columns = width - layout.width * layout.grid.u;
  if (rows == 0 && columns == 0) return;
  report.warnings.push_back(
      fmt::format("The picture has {}×{} px, which {} does not divide: the last {} columns and {} "
                  "rows of pixels are left out.",
                  width, height, grid_text(layout.grid), columns, rows));
}

std::vector<FileUse> account_of(const fs::path& path) {
  // Mosaics beside it are light fields of their own.
  FolderAccount account(is_only_mosaic(path) ? scene_folder(path) : path);
  account.use(path, "mosaics");
  return account.uses();
}

/// Truth in the folder of a mosaic, and what becomes of the files there.
void add_beside(const fs::path& path, const OpenOptions& options, SceneParts& parts, Scene& scene,
                const Progress& progress) {
  const bool is_itself_a_map = map_kind(path.stem().string()).has_value();
  if (is_itself_a_map) return;
  const fs::path folder = scene_folder(path);
  FolderAccount account(is_only_mosaic(path) ? folder : path);
  account.use(path, "mosaics");
  const ViewFiles views{grid_of(parts.samples), {}};
  const OwnFiles own(path);
  FoundBeside beside =
      read_beside({.files = views,
                   .folder = folder,
                   .samples = parts.samples,
                   .camera = parts.info.camera,
                   .map_views = options.map_views(),
                   .needs_truth = options.needs_truth,
                   .is_own = [&](const fs::path& file) { return own.contains(file); }},
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
  MosaicLayout layout;
  std::string origin;  ///< For the report; empty for an image.
  std::vector<FileUse> files;
};

bool may_have_gaps(const fs::path& path, const OpenOptions& options) {
  const MosaicName name = mosaic_name(path);
  return options.mosaic != Mosaic::Lenslets && options.lenslet == 0 &&
         (name == MosaicName::Plain || name == MosaicName::Mosaic);
}

/// Of views side by side, gaps between them are cut out of the picture.
MosaicLayout find_layout(AnyImage& picture, const fs::path& path, const OpenOptions& options) {
  if (may_have_gaps(path, options)) {
    const auto sheet = find_contact_sheet(picture);
    const auto given = given_grid(options);
    if (sheet && (!given || *given == sheet->grid())) {
      AnyImage tiles = without_gaps(picture, *sheet);
      MosaicLayout layout = find_mosaic_layout(tiles, path, options);
      if (layout.grid == sheet->grid() && layout.kind == Mosaic::Views) {
        picture = std::move(tiles);
        layout.evidence += "; " + sheet->text();
        return layout;
      }
    }
  }
  return find_mosaic_layout(picture, path, options);
}

MosaicPicture read_from_image(const fs::path& path, const OpenOptions& options) {
  AnyImage picture = decode_image(path);
  MosaicLayout layout = find_layout(picture, path, options);
  return {std::move(picture), std::move(layout), {}, account_of(path)};
}

/// What the dataset says is as if options said it, unless they do.
MosaicPicture read_from_dataset(const fs::path& path, const MosaicDataset& dataset,
                                OpenOptions options) {
  AnyImage picture = read_mosaic_dataset(path, dataset);
  if (options.mosaic == Mosaic::Auto && options.lenslet == 0) options.mosaic = dataset.kind;
  const bool is_stated = options.grid.empty() && options.lenslet == 0 && dataset.grid.count() > 0;
  if (is_stated) options.grid = fmt::format("{}x{}", dataset.grid.v, dataset.grid.u);
  MosaicLayout layout = find_mosaic_layout(picture, path, options, "the dataset " + dataset.name);
  if (is_stated) layout.evidence = "as an attribute says";
  const char* order = dataset.is_transposed ? ", stored by columns" : "";
  return {std::move(picture), std::move(layout),
          fmt::format(", HDF5 dataset {}{}", dataset.name, order), uses_beside(path, dataset)};
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
  LightField::Samples samples = split_mosaic(picture, layout, progress.part(0.5, 0.8));
  settle_range(samples, options.levels, report);
  SceneParts parts;
  parts.samples = std::move(samples);
  parts.info = std::move(info);
  parts.expected.reason = "mosaics hold rows and columns of views in order";
  parts.files = std::move(read.files);
  if (read.origin.empty()) add_beside(path, options, parts, scene, progress.part(0.8, 0.9));
  assemble(std::move(parts), options, scene, progress);
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
  if (name != MosaicName::Eslf && name != MosaicName::Lenslets) return {};
  const auto grid = find_lenslets(decode_png_top(path, kRows), header->height, path, options);
  if (!grid) return {};
  return {.grid = *grid,
          .height = header->height / grid->v,
          .width = header->width / grid->u,
          .channels = header->channels,
          .sample_type = header->sample_type};
}

constexpr const char* kOptions[] = {"flip",    "grid",    "crop",  "mosaic",
                                    "lenslet", "dataset", "levels"};

}  // namespace

Reader mosaic_reader() {
  return {.id = "mosaic",
          .name = "a mosaic of views",
          .options = kOptions,
          .find = find_mosaic,
          .read = read_mosaic,
          .probe = probe_mosaic};
}

}  // namespace episcope::io
