// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/image_grid_reader.h"

#include "engine/core/text/join.h"
#include "engine/core/text/suffix.h"
#include "engine/io/beside/beside.h"
#include "engine/io/grid/grid_names.h"
#include "engine/io/grid/grid_with_gaps.h"
#include "engine/io/grid/image_grid_probe.h"
#include "engine/io/grid/image_list.h"
#include "engine/io/grid/left_out.h"
#include "engine/io/grid/load_views.h"
#include "engine/io/grid/posed_views.h"
#include "engine/io/grid/row_folders.h"
#include "engine/io/grid/view_folders.h"
#include "engine/io/maps/sample_range.h"
#include "engine/io/open/assemble_scene.h"
#include "engine/io/open/folder_account.h"
#include "engine/io/open/order_parts.h"
#include "engine/io/open/scene_folder.h"
#include "engine/io/open/scene_name.h"
#include "engine/io/order/view_axes.h"

#include <fmt/format.h>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

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

FolderAccount account_of(const fs::path& source, const fs::path& folder, const ViewFiles& views,
                         const ImageGridExtras& extras) {
  FolderAccount account(source);
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

/// What poses tell of distances: that of cameras side by side, whose views are not shifted.
void add_camera(const PosedViews& poses, const LightField::Samples& samples, CameraGrid& camera,
                FolderAccount& account) {
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
/// maps are judged by the views beside them. Returns why, or nothing; null where that cannot be
/// done yet.
std::optional<std::string> settle_axes(ViewFiles& views, LightField::Samples& samples,
                                       std::vector<CameraPosition>& positions,
                                       const OpenOptions& options, const Progress& progress) {
  if (views.part || are_axes_stated(options)) return std::nullopt;
  const ViewAxes axes = find_view_axes(samples, progress);
  if (!axes.are_swapped()) return std::string();
  const GridShape stored = views.grid;
  swap_view_axes(samples);
  swap_view_axes(positions, stored);
  const std::vector<fs::path> files = views.files;
  views.grid = {stored.u, stored.v};
  for (int i = 0; i < stored.count(); ++i) {
    const ViewIndex view = views.grid.view_at(i);
    views.files[static_cast<std::size_t>(i)] =
        files[static_cast<std::size_t>(view.u * stored.u + view.v)];
  }
  return axes.evidence();
}

/// "image grid (out_{row}_{col}.png, snake order)", with the folder inside of what was opened.
std::string format_of(const NamedGrid& grid, const fs::path& folder, const fs::path& source,
                      const OpenOptions& options) {
  std::string format = "image grid (";
  if (folder != source) format += folder.filename().string() + "/";
  format += grid.pattern;
  if (options.snake) format += ", snake order";
  return format + ")";
}

/// Formats of float samples that are linear in light; their samples keep their scale.
bool is_linear_format(const fs::path& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".exr" || suffix == ".hdr";
}

constexpr const char* kOptions[] = {"flip", "crop", "pattern", "snake", "grid", "levels"};

}  // namespace

Reader image_grid_reader() {
  return {.id = "image_grid",
          .name = "a grid of images",
          .options = kOptions,
          .find = find_grid,
          .read = read_grid,
          .probe = probe_image_grid};
}

Scene read_image_grid(const fs::path& folder, const OpenOptions& options, const Progress& progress,
                      const ImageGridExtras& extras) {
  NamedGrid grid = name_grid(folder, options);
  const std::string evidence = settle_grid(folder, grid, options, progress.part(0, 0.15));
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
    report.warnings.push_back(fmt::format("The views are those of {}; pictures in {} are left out.",
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
      progress.part(0.15, 0.9));
  LightField::Samples samples = std::move(usable.samples);
  if (usable.kept) {
    info.positions = positions_of(*usable.kept, info.positions);
    views = std::move(usable.views);
    report.warnings.push_back(std::move(usable.warning));
  }
  if (!is_linear || !options.levels.empty()) settle_range(samples, options.levels, report);
  FolderAccount account = account_of(source, folder, views, extras);
  if (grid.poses.are_used()) add_camera(grid.poses, samples, info.camera, account);
  SceneParts parts;
  if (extras.read_truth) {
    parts.truth.field = extras.read_truth(samples, info.camera, report);
  } else {
    progress.step("checking the order of views");
    parts.swapped_axes = settle_axes(views, samples, info.positions, options, progress);
    FoundBeside beside = read_beside({views, folder, samples, info.camera, options.map_views(),
                                      options.needs_truth, grid.poses.are_used()},
                                     {account, report}, progress.part(0.9, 1));
    parts.truth = std::move(beside.truth);
    parts.expected.is_truth_sign_assumed = beside.is_sign_assumed;
    info.camera = beside.camera;
    scene.scribbles.labels = std::move(beside.label_infos);
  }
  if (!options.pattern.empty()) {
    grid.left_out = without_other_numbers(std::move(grid.left_out), views.files.front());
  }
  warn_of_left_out(grid.left_out, samples, report);
  parts.samples = std::move(samples);
  parts.info = std::move(info);
  parts.expected.reason = evidence.empty() ? "rows and columns follow from the names" : evidence;
  if (grid.poses.are_used()) parts.expected.reason = "the poses of the cameras say so";
  parts.files = account.uses();
  assemble(std::move(parts), options, scene, progress);
  if (!evidence.empty() && !report.order_check.ends_with(evidence)) {
    report.order_check = evidence + "; " + report.order_check;
  }
  return scene;
}

}  // namespace episcope::io
