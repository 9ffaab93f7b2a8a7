// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/list_grid.h"

#include "engine/core/error.h"
#include "engine/io/open/grid_option.h"
#include "engine/io/order/list_layout.h"

#include <fmt/format.h>

#include <algorithm>

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

}  // namespace

void arrange_list(const std::filesystem::path& path, const OpenOptions& options, SceneParts& parts,
                  std::string& reason, const Progress& progress) {
  const int count =
      std::visit([](const auto& stack) { return stack.grid().count(); }, parts.samples);
  ListLayout layout;
  if (const auto given = given_grid(options)) {
    if (given->count() != count) {
      throw InvalidInput(
          fmt::format("{}: the array has {} views, but a grid of {} has {}; state "
                      "another grid",
                      path.string(), count, grid_text(*given), given->count()));
    }
    layout.grid = *given;
    reason += fmt::format("; list of {} views, grid {} as chosen", count, grid_text(*given));
  } else {
    progress.step("arranging the views of the list");
    layout = find_list_layout(parts.samples, progress);
    if (!layout.is_decided) {
      throw IoError(path, fmt::format("the array is a list of {} views, and how they lie on a grid "
                                      "is not certain ({}); state it, as in --grid 1x{}",
                                      count, layout.evidence, count));
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
