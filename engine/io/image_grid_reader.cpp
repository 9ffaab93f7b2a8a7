// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/image_grid_reader.h"

#include "engine/io/grid_names.h"
#include "engine/io/load_views.h"
#include "engine/io/order_check.h"
#include "engine/io/scene_name.h"

namespace episcope::io {

Scene read_image_grid(const std::filesystem::path& folder, const OpenOptions& options,
                      const Progress& progress) {
  const NamedGrid grid = name_grid(folder, options.pattern, options.snake);
  const GridShape shape = grid.views.grid;
  Scene scene;
  ConventionReport& report = scene.convention;
  report.format = "image grid (" + grid.pattern + (options.snake ? ", snake order" : "") + ")";
  report.units = "no depth in an image grid";
  if (grid.left_out > 0) {
    report.warnings.push_back(std::to_string(grid.left_out) +
                              " images of the folder do not fit the pattern and are left out.");
  }
  LightFieldInfo info{scene_name(folder), folder.string(), {}, std::nullopt};
  progress.step("reading views");
  LightField::Samples samples = load_views(
      grid.views,
      [&](const Image<std::uint8_t>& center) {
        if (options.on_center_view) options.on_center_view(center, info, shape);
      },
      progress.part(0, 0.95));
  progress.step("checking the order of views");
  progress.check();
  const OrderFinding order =
      find_order(samples, {}, {{}, "rows and columns are as the names say"}, options.flip);
  report_order(order, report);
  report.reversed_u = order.flip.u;
  report.reversed_v = order.flip.v;
  std::visit([&](auto& stack) { reverse_views(stack, shape, order.flip); }, samples);
  scene.light_field = std::make_shared<LightField>(std::move(samples), std::move(info));
  scene.truth = std::make_shared<GroundTruth>();
  return scene;
}

}  // namespace episcope::io
