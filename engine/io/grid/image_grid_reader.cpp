// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/image_grid_reader.h"

#include "engine/io/grid/grid_names.h"
#include "engine/io/grid/load_views.h"
#include "engine/io/maps/float_samples.h"
#include "engine/io/open/assemble_scene.h"
#include "engine/io/open/scene_name.h"

namespace episcope::io {

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
    report.warnings.push_back(std::to_string(grid.left_out) +
                              " images of the folder do not fit the pattern and are left out.");
  }
  const std::filesystem::path& source = extras.source.empty() ? folder : extras.source;
  LightFieldInfo info{scene_name(source), source.string(), extras.camera, extras.disparity_range};
  progress.step("reading views");
  LightField::Samples samples = load_views(
      grid.views,
      [&](const Image<std::uint8_t>& center) {
        if (options.on_center_view) options.on_center_view(center, info, shape);
      },
      progress.part(0, 0.9));
  scale_float_samples(samples, report);
  GroundTruth truth;
  if (extras.read_truth) truth.field = extras.read_truth(samples, info.camera, report);
  assemble({std::move(samples),
            std::move(truth),
            std::move(info),
            {{}, "rows and columns are as the names say"}},
           options, scene, progress);
  return scene;
}

}  // namespace episcope::io
