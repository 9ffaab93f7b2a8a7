// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/names/grid_names.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/load_views.h"
#include "engine/io/models/names/view_files.h"
#include "engine/io/models/names/view_folders.h"
#include "engine/io/models/order/list_layout.h"
#include "engine/io/models/poses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> images_of(const fs::path& folder) {
  std::vector<fs::path> images = list_images(folder);
  if (!images.empty()) return images;
  for (const fs::path& part : folders_of_parts(folder)) {
    const std::vector<fs::path> more = list_images(part);
    images.insert(images.end(), more.begin(), more.end());
  }
  return images;
}

/// A grid that counts rows and columns from 0, without files.
GridWithGaps counted_grid(GridShape grid) {
  GridWithGaps views{.rows = std::vector<long long>(static_cast<std::size_t>(grid.v)),
                     .columns = std::vector<long long>(static_cast<std::size_t>(grid.u)),
                     .numbering = "from 0"};
  std::iota(views.rows.begin(), views.rows.end(), 0);
  std::iota(views.columns.begin(), views.columns.end(), 0);
  return views;
}

/// The largest part of cameras of which some are missing; empty if that is too small.
std::optional<PlacedViews> part_without_gaps(const PoseGrid& grid,
                                             const std::vector<fs::path>& images) {
  GridWithGaps views = counted_grid(grid.grid);
  for (const std::size_t i : grid.order) {
    views.files.push_back(i == kNoCamera ? fs::path() : images[i]);
  }
  const auto part = part_to_open(views);
  if (!part) return std::nullopt;
  PlacedViews placed;
  placed.views = files_of_part(views, *part);
  for (int i = 0; i < part->grid.count(); ++i) {
    const ViewIndex view = part->in_whole(part->grid.view_at(i));
    placed.positions.push_back(
        grid.positions[static_cast<std::size_t>(view.v * grid.grid.u + view.u)]);
  }
  placed.warnings.push_back(part_text(views, *part));
  return placed;
}

PosedViews place_by(FoundPoses found) {
  PosedViews posed{.files = std::move(found.files), .problem = std::move(found.problem)};
  if (!posed.problem.empty()) return posed;
  PoseGrid grid = find_pose_grid(found.poses);
  posed.problem = grid.problem;
  if (!posed.problem.empty()) return posed;
  if (std::ranges::find(grid.order, kNoCamera) != grid.order.end()) {
    auto part = part_without_gaps(grid, found.images);
    if (!part) {
      posed.problem = fmt::format("{} cameras do not fill a grid of {} or a part of it",
                                  found.images.size(), grid_text(grid.grid));
      return posed;
    }
    posed.placed = std::move(*part);
    grid.step *= posed.placed.views.part->step;
  } else {
    posed.placed.views.grid = grid.grid;
    for (const std::size_t i : grid.order) posed.placed.views.files.push_back(found.images[i]);
    posed.placed.positions = std::move(grid.positions);
  }
  posed.step = grid.step;
  posed.focal_widths = grid.focal_widths;
  posed.evidence = fmt::format("{} by {}: {}", grid_text(grid.grid), posed.name(), grid.evidence);
  return posed;
}

// Throws IoError that says why the poses form no light field.
[[noreturn]] void refuse_poses(const fs::path& folder, const PosedViews& poses) {
  throw IoError(folder, fmt::format("by {}, {}; a light field has parallel cameras on a plane, in "
                                    "equal steps: render such views, or name rows and columns by "
                                    "--grid if these are some",
                                    poses.name(), poses.problem));
}

}  // namespace

std::string PosedViews::name() const {
  std::vector<fs::path> poses = files;
  std::erase_if(poses, [](const fs::path& file) { return file.stem() == "cameras"; });
  return joined(poses, ", ", [](const fs::path& file) { return file.filename().string(); });
}

bool has_parts_with_poses(const fs::path& folder) {
  return count_images(folder) == 0 && !images_of(folder).empty();
}

namespace {

/// The views of a folder that has, or whose parent has, files of poses (read_poses.h), where these
/// are those of a light field (poses.h); not where options say how names are meant.
PosedViews place_by_poses(const fs::path& folder, const OpenOptions& options) {
  if (!options.pattern.empty() || !options.grid.empty() || options.snake) return {};
  PosedViews with_gaps;
  PosedViews first;
  for (FoundPoses& found : find_poses(folder, folder.parent_path(), images_of(folder))) {
    PosedViews posed = place_by(std::move(found));
    if (posed.are_used() && !posed.placed.views.part) return posed;
    PosedViews& kept = posed.are_used() ? with_gaps : first;
    if (kept.files.empty()) kept = std::move(posed);
  }
  return with_gaps.are_used() ? with_gaps : first;
}

std::vector<fs::path> left_out_of(const std::vector<fs::path>& images, const ViewFiles& views) {
  std::vector<fs::path> taken = views.files;
  taken.insert(taken.end(), views.left_out.begin(), views.left_out.end());
  const auto by_text = [](const fs::path& path) { return std::string_view(path.native()); };
  std::ranges::sort(taken, {}, by_text);
  std::vector<fs::path> left_out;
  std::ranges::set_difference(images, taken, std::back_inserter(left_out), {}, by_text, by_text);
  return left_out;
}

/// A view as grey values of any range, reduced to about 512 px.
Image<float> gray_view(const fs::path& path, int orientation) {
  constexpr int kSide = 512;
  return std::visit(
      [](const auto& image) {
        const int step = std::max(1, std::max(image.height(), image.width()) / kSide);
        Image<float> grey(image.height() / step, image.width() / step);
        for (int y = 0; y < grey.height() * step; ++y) {
          const auto* in = image.row(y);
          float* out = grey.row(y / step);
          for (int x = 0; x < grey.width() * step; ++x) {
            for (int c = 0; c < image.channels(); ++c) {
              out[x / step] += static_cast<float>(*in++);
            }
          }
        }
        return grey;
      },
      upright(decode_image(path), orientation));
}

/// Moves the files of a list to where they lie in a grid.
void arrange(PlacedViews& placed, const ListLayout& layout) {
  std::vector<fs::path> files(placed.views.files.size());
  std::vector<CameraPosition> positions(placed.positions.size());
  for (int i = 0; i < layout.grid.count(); ++i) {
    const ViewIndex at = layout.place(i);
    const auto from = static_cast<std::size_t>(i);
    const auto to = static_cast<std::size_t>(at.v * layout.grid.u + at.u);
    files[to] = std::move(placed.views.files[from]);
    if (!positions.empty()) positions[to] = placed.positions[from];
  }
  placed.views.grid = layout.grid;
  placed.views.files = std::move(files);
  placed.positions = std::move(positions);
}

/// Of views of which some may be damaged or of another size, one that is like most: of the first,
/// the middle and the last. Throws IoError if the first two of these cannot be decoded.
Image<float> usual_view(const ViewFiles& list) {
  const auto view = [&](std::size_t place) -> std::optional<Image<float>> {
    try {
      return gray_view(list.files[place], list.orientation);
    } catch (const IoError&) {
      return std::nullopt;
    }
  };
  const auto first = view(0);
  const auto middle = view(list.files.size() / 2);
  const auto is_same = [](const std::optional<Image<float>>& a, const Image<float>& b) {
    return a && a->height() == b.height() && a->width() == b.width();
  };
  if (first && is_same(middle, *first)) return *first;
  const auto last = view(list.files.size() - 1);
  if (first && (is_same(last, *first) || !middle)) return *first;
  return middle ? *middle : gray_view(list.files.front(), list.orientation);
}

/// What the images of a list tell about their places. Those that cannot be used are blank, which
/// tells nothing.
ListLayout look_for_layout(const ViewFiles& list, const Progress& progress) {
  const Image<float> usual = usual_view(list);
  const auto view = [&](int index) {
    const Image<float> blank(usual.height(), usual.width());
    try {
      Image<float> grey = gray_view(list.files[static_cast<std::size_t>(index)], list.orientation);
      const bool fits = grey.height() == usual.height() && grey.width() == usual.width();
      return fits ? grey : blank;
    } catch (const IoError&) {
      return blank;
    }
  };
  return find_list_layout(list.grid.count(), view, progress);
}

/// What a user says without a word about columns.
ListLayout row_by_row(GridShape grid, const OpenOptions& options) {
  ListLayout layout;
  layout.grid = grid;
  layout.order = options.snake ? ListOrder::SnakeRows : ListOrder::Rows;
  layout.is_decided = true;
  layout.evidence = "as given";
  return layout;
}

[[noreturn]] void ask_for_grid(const fs::path& folder, const std::string& why, int count) {
  throw Undecided(folder, why, "grid", possible_grids(count));
}

/// Puts the views of a list with gaps into the grid that was given, and takes the part of it that
/// has none. Throws Undecided without such a grid: the images of such a list tell too little.
void place_list_with_gaps(const fs::path& folder, PlacedViews& placed, const OpenOptions& options) {
  const ListGaps& gaps = *placed.gaps;
  const auto given = given_grid(options);
  if (!given || given->count() != gaps.length) {
    ask_for_grid(folder,
                 fmt::format("{}, and how {} numbers lie in rows and columns is not certain",
                             gaps.text, gaps.length),
                 gaps.length);
  }
  GridWithGaps views = counted_grid(*given);
  views.files.resize(static_cast<std::size_t>(gaps.length));
  std::vector<CameraPosition> positions(views.files.size());
  const ListLayout layout = row_by_row(*given, options);
  for (std::size_t i = 0; i < gaps.places.size(); ++i) {
    const ViewIndex at = layout.place(gaps.places[i]);
    const auto place = static_cast<std::size_t>(at.v * given->u + at.u);
    views.files[place] = placed.views.files[i];
    if (!placed.positions.empty()) positions[place] = placed.positions[i];
  }
  const auto part = part_to_open(views);
  if (!part)
    throw IoError(folder, gaps.text + "; no part of the grid is whole: add what is missing");
  PlacedViews kept;
  kept.views = files_of_part(views, *part);
  kept.views.orientation = placed.views.orientation;
  kept.warnings = placed.warnings;
  for (int i = 0; i < given->count() && !placed.positions.empty(); ++i) {
    const bool is_kept = part->in_part(given->view_at(i)).has_value();
    if (is_kept) kept.positions.push_back(positions[static_cast<std::size_t>(i)]);
  }
  kept.warnings.push_back(part_text(views, *part));
  placed = std::move(kept);
}

ListLayout layout_of_list(const fs::path& folder, const ViewFiles& list, const OpenOptions& options,
                          const Progress& progress) {
  const int count = list.grid.count();
  if (const auto given = given_grid(options)) {
    if (given->count() == count) return row_by_row(*given, options);
    throw IoError(folder, fmt::format("{} views are in the list, but --grid {} has {}; give a grid "
                                      "of {} views",
                                      count, options.grid, given->count(), count));
  }
  progress.step("looking for rows and columns");
  ListLayout layout = look_for_layout(list, progress);
  if (!layout.is_decided) {
    ask_for_grid(folder,
                 fmt::format("the names number {} views in one line, and how these lie in rows "
                             "and columns is not certain: {}",
                             count, layout.evidence),
                 count);
  }
  return layout;
}

ViewFiles middle_line(const ViewFiles& views, bool is_row) {
  const GridShape grid = views.grid;
  const ViewIndex center = grid.center();
  ViewFiles line{.grid = {1, is_row ? grid.u : grid.v}, .files = {}};
  line.orientation = views.orientation;
  for (int i = 0; i < line.grid.u; ++i) {
    const int place = is_row ? center.v * grid.u + i : i * grid.u + center.u;
    line.files.push_back(views.files[static_cast<std::size_t>(place)]);
  }
  return line;
}

bool has_divisors(int count) {
  for (int d = 2; d * d <= count; ++d) {
    if (count % d == 0) return true;
  }
  return false;
}

/// Numbers of a frame and of a camera on a grid look like numbers of rows and columns. But
/// views of a row do not lie on a grid themselves: then the other number counts frames.
/// Looks where there are not as many rows as columns.
void refuse_frames(const fs::path& folder, const NamedGrid& named, const Progress& progress) {
  const GridShape grid = named.placed.views.grid;
  if (grid.v == grid.u || !named.placed.positions.empty()) return;
  for (const bool is_row : {true, false}) {
    const ViewFiles line = middle_line(named.placed.views, is_row);
    if (!has_divisors(line.grid.count())) continue;
    const ListLayout layout = look_for_layout(line, progress);
    if (!layout.is_decided || std::min(layout.grid.v, layout.grid.u) == 1) continue;
    throw IoError(
        folder,
        fmt::format("by the numbers in the names, {}, these are {} rows of {} views, but the views "
                    "of a {} lie on a grid of {} themselves ({}): the other number rather counts "
                    "frames. Open one frame by --pattern with its number and {{index}}, as of {}, "
                    "or all by --pattern with {{row}} and {{col}}",
                    named.pattern, grid.v, grid.u, is_row ? "row" : "column",
                    grid_text(layout.grid), layout.evidence,
                    line.files.front().filename().string()));
  }
}

/// Where the views leave it open, poses that are none of a light field decide that it is none.
ListLayout layout_by_views(const fs::path& folder, const NamedGrid& named,
                           const OpenOptions& options, const Progress& progress) {
  try {
    return layout_of_list(folder, named.placed.views, options, progress);
  } catch (const Undecided&) {
    if (named.poses.problem.empty()) throw;
    refuse_poses(folder, named.poses);
  }
}

/// Views of cameras that were turned are shown upright.
void settle_orientation(PlacedViews& placed) {
  CommonOrientation orientation = common_orientation(placed.views.files);
  placed.views.orientation = orientation.value;
  if (!orientation.note.empty()) placed.warnings.push_back(std::move(orientation.note));
}

NamedGrid by_poses(const fs::path& folder, PosedViews poses) {
  NamedGrid grid{
      std::move(poses.placed), fmt::format(finding_text("format.posed"), poses.name()), {}};
  grid.left_out = left_out_of(list_images(folder), grid.placed.views);
  grid.poses = std::move(poses);
  settle_orientation(grid.placed);
  return grid;
}

NamedGrid by_view_folders(const fs::path& folder, const ViewNames& names,
                          const OpenOptions& options) {
  NamedGrid grid{
      place_views(folder, options.snake ? with_turned_rows(names) : names), names.pattern, {}};
  settle_orientation(grid.placed);
  return grid;
}

/// Without poses.
NamedGrid by_names(const fs::path& folder, const OpenOptions& options) {
  if (const auto rows = find_row_folders(folder, options)) {
    NamedGrid grid{place_rows(folder, *rows, options.snake), rows->pattern, {}};
    if (options.snake && !grid.placed.views.part)
      arrange(grid.placed, row_by_row(grid.placed.views.grid, options));
    settle_orientation(grid.placed);
    return grid;
  }
  const std::string& pattern = options.pattern;
  if (const auto views = find_view_folders(folder, pattern)) {
    return by_view_folders(folder, *views, options);
  }
  const std::vector<fs::path> images = list_images(folder);
  const ViewNames names =
      pattern.empty() ? find_view_names(folder, images) : match_view_names(images, pattern);
  if (names.views.size() < 2) {
    throw IoError(folder,
                  fmt::format("the images do not form a grid of views: pattern {} matches "
                              "{} of {} images{}; {}",
                              pattern, names.views.size(), images.size(),
                              images.empty() ? std::string()
                                             : ", such as " + images.front().filename().string(),
                              kPatternAdvice));
  }
  NamedGrid grid{
      place_views(folder, options.snake ? with_turned_rows(names) : names), names.pattern, {}};
  grid.left_out = left_out_of(images, grid.placed.views);
  settle_orientation(grid.placed);
  return grid;
}

}  // namespace

std::vector<ReadingChoice> possible_grids(int count) {
  constexpr std::size_t kMostGrids = 4;
  std::vector<ReadingChoice> choices;
  const auto add = [&](int rows, int columns, const std::string& label) {
    choices.push_back({fmt::format("{}x{}", rows, columns), label});
  };
  for (int rows = static_cast<int>(std::sqrt(count)); rows > 1; --rows) {
    if (count % rows != 0 || choices.size() >= kMostGrids) continue;
    const int columns = count / rows;
    add(rows, columns, fmt::format("{} rows of {} views", rows, columns));
    if (rows != columns) add(columns, rows, fmt::format("{} rows of {} views", columns, rows));
  }
  add(1, count, fmt::format("{} views in a row", count));
  add(count, 1, fmt::format("{} views in a column", count));
  return choices;
}

NamedGrid name_grid(const fs::path& folder, const OpenOptions& options) {
  PosedViews poses = place_by_poses(folder, options);
  if (poses.are_used()) return by_poses(folder, std::move(poses));
  if (!poses.problem.empty() && has_parts_with_poses(folder)) refuse_poses(folder, poses);
  NamedGrid grid = by_names(folder, options);
  if (!poses.problem.empty()) {
    grid.placed.warnings.push_back(
        fmt::format(finding_text("views.poses_unused"), poses.name(), poses.problem));
  }
  grid.poses = std::move(poses);
  return grid;
}

std::string settle_grid(const fs::path& folder, NamedGrid& named, const OpenOptions& options,
                        const Progress& progress) {
  PlacedViews& placed = named.placed;
  if (named.poses.are_used()) return named.poses.evidence;
  if (!placed.is_list) {
    const bool is_said = !options.pattern.empty() || !options.grid.empty() || options.snake;
    if (!is_said && !placed.views.part) refuse_frames(folder, named, progress);
    const auto given = given_grid(options);
    const auto& part = placed.views.part;
    if (given && !(*given == placed.views.grid) && !(part && *given == part->whole)) {
      throw IoError(folder,
                    fmt::format("the names give a grid of {}, but --grid says {}; leave "
                                "--grid out, or number the views by --pattern with {{index}}",
                                grid_text(placed.views.grid), grid_text(*given)));
    }
    return {};
  }
  if (placed.gaps) {
    place_list_with_gaps(folder, placed, options);
    return layout_text(row_by_row(placed.views.part->whole, options)) + ": as given";
  }
  ListLayout layout = layout_by_views(folder, named, options, progress);
  if (options.snake) layout.order = ListOrder::SnakeRows;
  arrange(placed, layout);
  placed.is_list = false;
  return layout_text(layout) + ": " + layout.evidence;
}

}  // namespace episcope::io
