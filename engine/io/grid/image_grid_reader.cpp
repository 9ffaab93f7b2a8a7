// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/image_grid_reader.h"

#include "engine/io/beside/beside.h"
#include "engine/io/grid/grid_names.h"
#include "engine/io/grid/load_views.h"
#include "engine/io/maps/float_samples.h"
#include "engine/io/open/assemble_scene.h"
#include "engine/io/open/folder_account.h"
#include "engine/io/open/scene_folder.h"
#include "engine/io/open/scene_name.h"

#include <fmt/format.h>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

fs::path find_grid(const fs::path& path, const OpenOptions&) {
  const fs::path folder = scene_folder(path);
  if (folder.empty()) return {};
  for (const char* name : {"lf", "views", "images", "rectified"}) {
    if (fs::is_directory(folder / name) && count_images(folder / name) > 1) return folder / name;
  }
  return count_images(folder) > 0 ? folder : fs::path();
}

Scene read_grid(const fs::path& folder, const OpenOptions& options, const Progress& progress) {
  return read_image_grid(folder, options, progress);
}

constexpr const char* kOptions[] = {"flip", "pattern", "snake"};

}  // namespace

Reader image_grid_reader() {
  return {.id = "image_grid",
          .name = "a grid of images",
          .options = kOptions,
          .find = find_grid,
          .read = read_grid};
}

Scene read_image_grid(const std::filesystem::path& folder, const OpenOptions& options,
                      const Progress& progress, const ImageGridExtras& extras) {
  const NamedGrid grid = name_grid(folder, options.pattern, options.snake);
  const GridShape shape = grid.views.grid;
  Scene scene;
  ConventionReport& report = scene.convention;
  report.format = extras.format.empty()
                      ? "image grid (" + grid.pattern + (options.snake ? ", snake order" : "") + ")"
                      : extras.format;
  report.units = "no depth in an image grid";
  if (grid.left_out > 0) {
    report.warnings.push_back(fmt::format(
        "{} images of the folder do not match the pattern and are ignored.", grid.left_out));
  }
  const std::filesystem::path& source = extras.source.empty() ? folder : extras.source;
  LightFieldInfo info{scene_name(source),
                      source.string(),
                      extras.camera,
                      extras.disparity_range,
                      {.reader = extras.reader, .options = {}}};
  progress.step("reading views");
  LightField::Samples samples = load_views(
      grid.views,
      [&](const Image<std::uint8_t>& center) {
        if (options.on_center_view) options.on_center_view(center, info, shape);
      },
      progress.part(0, 0.9));
  scale_float_samples(samples, report);
  FolderAccount account(folder);
  account.use(grid.views.files, "views");
  GroundTruth truth;
  if (extras.read_truth) {
    truth.field = extras.read_truth(samples, info.camera, report);
  } else {
    FoundBeside beside = read_beside(
        {grid.views, folder, samples, info.camera, options.map_views(), options.needs_truth},
        {account, report}, progress.part(0.9, 1));
    truth = std::move(beside.truth);
    info.camera = beside.camera;
    scene.scribbles.labels = std::move(beside.label_infos);
  }
  assemble({std::move(samples),
            std::move(truth),
            std::move(info),
            {{}, "rows and columns follow from the names"},
            {},
            account.uses()},
           options, scene, progress);
  return scene;
}

}  // namespace episcope::io
