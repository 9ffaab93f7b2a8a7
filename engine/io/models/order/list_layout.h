// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"

#include <functional>
#include <string>

namespace episcope::io {

/// Order in which a list runs through a grid of views.
enum class ListOrder { Rows, Columns, SnakeRows, SnakeColumns };

/// Grid of the views of a list.
struct ListLayout {
  GridShape grid;  ///< 1×N for a scan to the right or left, N×1 for one up or down.
  ListOrder order = ListOrder::Rows;
  bool is_decided = false;
  /// A sentence without full stop: measurements and conclusion, or why there is none.
  std::string evidence;

  /// Place of view number `index` of the list.
  [[nodiscard]] ViewIndex place(int index) const;
};

/// "7×7, row by row", "1×49", "9×9, column by column in snake order".
[[nodiscard]] std::string layout_text(const ListLayout& layout);

/// Returns a grey view of the list, of any range of values; all have one size. Called at most once
/// for a view, from several threads. For long lists called for at most 140 views. The view may be
/// reduced to about 512 px.
using GreyViewOfList = std::function<Image<float>(int index)>;

/// Determines whether a list of views is a grid (row by row, column by column, or either in snake
/// order) or a scan along a line. Views differ more, the farther apart their cameras are. Every
/// arrangement is tried and judged by the share of the differences that distance does not explain.
/// Neighbors in the two directions must then differ by motion along the two image axes. Undecided
/// if no arrangement fits or several do. Of two views only the axis is found. Directions are not
/// determined: reversed rows look alike. Throws InvalidInput for fewer than two views, Cancelled,
/// and what `view` throws.
[[nodiscard]] ListLayout find_list_layout(int count, const GreyViewOfList& view,
                                          const Progress& progress);

/// Finds the layout of views in memory, taken row by row.
[[nodiscard]] ListLayout find_list_layout(const LightField::Samples& samples,
                                          const Progress& progress);

}  // namespace episcope::io
