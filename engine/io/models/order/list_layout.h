// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"

#include <functional>
#include <string>

namespace episcope::io {

/// In which order a list goes through a grid of views.
enum class ListOrder { Rows, Columns, SnakeRows, SnakeColumns };

/// How the views of a list lie.
struct ListLayout {
  GridShape grid;  ///< 1×N for a scan to the right or left, N×1 for one up or down.
  ListOrder order = ListOrder::Rows;
  bool is_decided = false;
  /// A sentence without full stop: what was measured and what follows, or why nothing does.
  std::string evidence;

  /// Where view number `index` of the list lies.
  [[nodiscard]] ViewIndex place(int index) const;
};

/// "7×7, row by row", "1×49", "9×9, column by column in snake order".
[[nodiscard]] std::string layout_text(const ListLayout& layout);

/// A grey view of the list, of any range of values, all of the same size. Called at most once for a
/// view, from several threads, and for long lists for some of the views only (at most 140). It may
/// be reduced to about 512 px.
using GreyViewOfList = std::function<Image<float>(int index)>;

/// Finds out whether a list of views is a grid (of any numbers of rows and columns) row by row or
/// column by column, the same in snake order, or a scan along a line, from how unlike the views
/// are: that grows with the distance of the cameras. Every arrangement is tried, and judged by the
/// share of the unlikeness that does not follow from distance; then it is checked that neighbours
/// in the two directions differ by motion along the two image axes. Not decided if no arrangement
/// fits, or several do. Of two views only the axis is found. Directions are not: reversed rows look
/// the same. Throws InvalidInput for less than two views, Cancelled, and what `view` throws.
[[nodiscard]] ListLayout find_list_layout(int count, const GreyViewOfList& view,
                                          const Progress& progress);

/// The same for views at hand, taken row by row.
[[nodiscard]] ListLayout find_list_layout(const LightField::Samples& samples,
                                          const Progress& progress);

}  // namespace episcope::io
