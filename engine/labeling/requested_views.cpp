// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/requested_views.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope {

void require_views(ViewRectangle views, GridShape grid) {
  const ViewIndex last{views.first.v + views.grid.v - 1, views.first.u + views.grid.u - 1};
  if (views.grid.v > 0 && views.grid.u > 0 && grid.contains(views.first) && grid.contains(last)) {
    return;
  }
  throw InvalidInput(
      fmt::format("views {} to {} were requested, but there are {}×{} views, counted from 0",
                  view_text(views.first), view_text(last), grid.v, grid.u));
}

void require_disparity(Regularizer regularizer, bool has_disparity) {
  if (has_disparity || !info_of(regularizer).joins_views) return;
  throw InvalidInput(
      "labels that are consistent along rays need the disparity of all views; estimate it first, "
      "or smooth each view alone");
}

ViewRectangle neighbours(ViewIndex view, GridShape grid) {
  const int down = grid.u > 1 ? 0 : 1;
  const int across = 1 - down;
  const ViewIndex first{std::max(view.v - down, 0), std::max(view.u - across, 0)};
  const ViewIndex last{std::min(view.v + down, grid.v - 1), std::min(view.u + across, grid.u - 1)};
  return {first, {last.v - first.v + 1, last.u - first.u + 1}};
}

}  // namespace episcope
