// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"

#include <optional>
#include <vector>

namespace episcope::io {

/// Views in equal steps out of a grid, the same steps along rows and columns.
struct PartOfGrid {
  GridShape whole;
  ViewIndex first;  ///< In the whole grid.
  int step = 1;
  GridShape grid;

  /// The place in the whole grid of a view of the part.
  [[nodiscard]] ViewIndex in_whole(ViewIndex view) const;
  /// The place in the part of a view of the whole grid; nothing if the part leaves it out.
  [[nodiscard]] std::optional<ViewIndex> in_part(ViewIndex view) const;
};

/// The largest part of which every place is filled (`is_filled`, row by row). Of several as large
/// the squarest, of these the densest, then the widest, then the one nearest to the centre of the
/// whole grid. O(V·U²).
[[nodiscard]] PartOfGrid largest_filled_part(const std::vector<bool>& is_filled, GridShape whole);

}  // namespace episcope::io
