// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/list_grid.h"

#include "engine/core/error.h"
#include "engine/io/open/grid_option.h"
#include "engine/io/open/undecided.h"
#include "engine/io/order/list_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace episcope::io {
namespace {

template <class T>
void arrange(ViewStack<T>& stack, const ListLayout& layout) {
  if (stack.empty()) return;
  if (stack.grid().count() == 1) {
    ViewStack<T> center({1, 1}, stack.height(), stack.width(), stack.channels(),
                        layout.grid.center());
    std::copy_n(stack.data(), stack.size(), center.data());
    stack = std::move(center);
    return;
  }
  ViewStack<T> grid(layout.grid, stack.height(), stack.width(), stack.channels());
  for (int i = 0; i < layout.grid.count(); ++i) {
    std::copy_n(stack.view({0, i}).data, stack.view_size(), grid.view(layout.place(i)).data);
  }
  stack = std::move(grid);
}

/// A row, a column, and the grids of several.
std::vector<ReadingChoice> grid_choices(int count) {
  std::vector<ReadingChoice> choices{
      {fmt::format("1x{}", count), fmt::format("{} views in a row", count)},
      {fmt::format("{}x1", count), fmt::format("{} views in a column", count)}};
  for (int rows = 2; rows < count; ++rows) {
    if (count % rows != 0) continue;
    choices.push_back({fmt::format("{}x{}", rows, count / rows),
                       fmt::format("{} rows of {} views", rows, count / rows)});
  }
  return choices;
}

}  // namespace

void arrange_list(const std::filesystem::path& path, const OpenOptions& options, SceneParts& parts,
                  std::string& reason, const Progress& progress, std::optional<GridShape> stored) {
  const int count =
      std::visit([](const auto& stack) { return stack.grid().count(); }, parts.samples);
  ListLayout layout;
  if (const auto given = given_grid(options)) {
    if (given->count() != count) {
      throw InvalidInput(
          fmt::format("{}: there are {} views, but a grid of {} has {}; state "
                      "another grid",
                      path.string(), count, grid_text(*given), given->count()));
    }
    layout.grid = *given;
    reason += fmt::format("; list of {} views, grid {} as chosen", count, grid_text(*given));
  } else {
    progress.step("arranging the views of the list");
    layout = find_list_layout(parts.samples, progress);
    if (!layout.is_decided && stored && stored->count() == count) {
      layout.grid = *stored;
      layout.order = ListOrder::Rows;
      layout.evidence = "as stored, for the views do not tell: " + layout.evidence;
    } else if (!layout.is_decided) {
      throw Undecided(path,
                      fmt::format("this is a list of {} views, and how they lie on a grid is "
                                  "not certain ({})",
                                  count, layout.evidence),
                      "grid", grid_choices(count));
    }
    reason +=
        fmt::format("; list of {} views, {}: {}", count, layout_text(layout), layout.evidence);
  }
  std::visit([&](auto& stack) { arrange(stack, layout); }, parts.samples);
  arrange(parts.valid, layout);
  arrange(parts.truth.field.disparity, layout);
  arrange(parts.truth.field.valid, layout);
  arrange(parts.truth.labels, layout);
}

}  // namespace episcope::io
