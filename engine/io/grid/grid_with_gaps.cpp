// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/grid_with_gaps.h"

#include "engine/io/grid/number_run.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr int kFewestViews = 3;
constexpr std::size_t kSmallestShare = 4;  ///< One of so many views that are there.

bool is_there(const GridWithGaps& views, ViewIndex view) {
  const GridShape shape = views.shape();
  return !views.files[static_cast<std::size_t>(view.v * shape.u + view.u)].empty();
}

/// Whether the views are exactly those of one row and one column.
bool is_cross(const GridWithGaps& views, ViewIndex middle) {
  const GridShape shape = views.shape();
  for (int i = 0; i < shape.count(); ++i) {
    const ViewIndex view = shape.view_at(i);
    if (is_there(views, view) != (view.v == middle.v || view.u == middle.u)) return false;
  }
  return shape.v > 1 && shape.u > 1;
}

std::optional<ViewIndex> middle_of_cross(const GridWithGaps& views, const PartOfGrid& line) {
  for (int i = 0; i < line.grid.count(); ++i) {
    const ViewIndex view = line.in_whole(line.grid.view_at(i));
    if (is_cross(views, view)) return view;
  }
  return std::nullopt;
}

/// "row 4", "columns 0, 2 … 8".
std::string numbers_text(const char* what, const std::vector<long long>& all, int first, int count,
                         int step) {
  std::vector<long long> values;
  for (int i = 0; i < count; ++i) values.push_back(all[static_cast<std::size_t>(first + i * step)]);
  return fmt::format("{}{} {}", what, count == 1 ? "" : "s", NumberRun(values).text());
}

}  // namespace

GridShape GridWithGaps::shape() const {
  return {static_cast<int>(rows.size()), static_cast<int>(columns.size())};
}

std::size_t GridWithGaps::missing() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(files, [](const auto& file) { return file.empty(); }));
}

std::string missing_text(const std::vector<std::string>& first, std::size_t count) {
  if (count == 1) return "view " + first.front() + " is missing";
  std::string text = fmt::format("{} views are missing:", count);
  for (const std::string& each : first) (text += ' ') += each;
  return count > first.size() ? text + " …" : text;
}

std::string missing_text(const GridWithGaps& views) {
  std::vector<std::string> first;
  const GridShape shape = views.shape();
  for (int i = 0; i < shape.count() && first.size() < kMostNamedViews; ++i) {
    const ViewIndex view = shape.view_at(i);
    if (is_there(views, view)) continue;
    first.push_back(fmt::format("{},{}", views.rows[static_cast<std::size_t>(view.v)],
                                views.columns[static_cast<std::size_t>(view.u)]));
  }
  return missing_text(first, views.missing());
}

std::optional<PartOfGrid> part_to_open(const GridWithGaps& views) {
  std::vector<bool> is_filled;
  for (const auto& file : views.files) is_filled.push_back(!file.empty());
  const PartOfGrid part = largest_filled_part(is_filled, views.shape());
  const auto count = static_cast<std::size_t>(part.grid.count());
  const std::size_t there = views.files.size() - views.missing();
  const bool is_worth_it = part.grid.count() >= kFewestViews && count * kSmallestShare >= there;
  return is_worth_it ? std::optional(part) : std::nullopt;
}

ViewFiles files_of_part(const GridWithGaps& views, const PartOfGrid& part) {
  ViewFiles files{part.grid, {}, part};
  const GridShape shape = views.shape();
  for (int i = 0; i < shape.count(); ++i) {
    const fs::path& file = views.files[static_cast<std::size_t>(i)];
    if (file.empty()) continue;
    (part.in_part(shape.view_at(i)) ? files.files : files.left_out).push_back(file);
  }
  return files;
}

std::string part_text(const GridWithGaps& views, const PartOfGrid& part) {
  const GridShape shape = views.shape();
  const std::string rows = numbers_text("row", views.rows, part.first.v, part.grid.v, part.step);
  const std::string columns =
      numbers_text("column", views.columns, part.first.u, part.grid.u, part.step);
  const std::size_t others =
      views.files.size() - views.missing() - static_cast<std::size_t>(part.grid.count());
  if (const auto middle = middle_of_cross(views, part)) {
    const bool is_row = part.grid.v == 1;
    return fmt::format(
        "The views form a cross of row {} and column {} ({}): those of the {}, {}×{}, are opened, "
        "the {} others are not used; a pattern with the number of the {} instead of {} opens "
        "these.",
        views.rows[static_cast<std::size_t>(middle->v)],
        views.columns[static_cast<std::size_t>(middle->u)], views.numbering,
        is_row ? "row" : "column", part.grid.v, part.grid.u, others, is_row ? "column" : "row",
        is_row ? "{col}" : "{row}");
  }
  return fmt::format(
      "Of a grid of {}×{} {} (row,column {}): the largest part without a gap is opened, {}×{} "
      "views, {} and {}; {} other view{} not used.",
      shape.v, shape.u, missing_text(views), views.numbering, part.grid.v, part.grid.u, rows,
      columns, others, others == 1 ? " is" : "s are");
}

}  // namespace episcope::io
