// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/part_of_grid.h"

#include <algorithm>
#include <cstdlib>
#include <tuple>

namespace episcope::io {
namespace {

/// Number of steps that fit into `length` places.
int steps_in(int length, int step) {
  return (length + step - 1) / step;
}

/// What speaks for a part, the most important first.
auto merit_of(const PartOfGrid& part) {
  const auto off_center = [&](int first, int count, int length) {
    return std::abs(2 * first + (count - 1) * part.step - (length - 1));
  };
  return std::tuple(part.grid.count(), std::min(part.grid.v, part.grid.u), -part.step, part.grid.u,
                    -off_center(part.first.v, part.grid.v, part.whole.v) -
                        off_center(part.first.u, part.grid.u, part.whole.u));
}

/// The largest part with one step and one first place, of which others are multiples of the step
/// away.
class Search {
 public:
  Search(const std::vector<bool>& is_filled, PartOfGrid& best)
      : is_filled_(is_filled), best_(best) {}

  void look(int step, ViewIndex offset) {
    const GridShape whole = best_.whole;
    const int columns = steps_in(whole.u - offset.u, step);
    std::vector<int> heights(static_cast<std::size_t>(columns));  // filled places upwards
    for (int row = 0; offset.v + row * step < whole.v; ++row) {
      for (int column = 0; column < columns; ++column) {
        const int place = (offset.v + row * step) * whole.u + offset.u + column * step;
        int& height = heights[static_cast<std::size_t>(column)];
        height = is_filled_[static_cast<std::size_t>(place)] ? height + 1 : 0;
      }
      for (int column = 0; column < columns; ++column) {
        take_better(step, offset, row, column, heights);
      }
    }
  }

 private:
  /// The widest part that ends in this row and is as high as the places above this one.
  void take_better(int step, ViewIndex offset, int row, int column,
                   const std::vector<int>& heights) {
    const auto height_at = [&](int i) { return heights[static_cast<std::size_t>(i)]; };
    const int height = height_at(column);
    if (height == 0) return;
    int begin = column;
    int end = column + 1;
    while (begin > 0 && height_at(begin - 1) >= height) --begin;
    while (end < static_cast<int>(heights.size()) && height_at(end) >= height) ++end;
    const PartOfGrid part{best_.whole,
                          {offset.v + (row - height + 1) * step, offset.u + begin * step},
                          step,
                          {height, end - begin}};
    if (merit_of(part) > merit_of(best_)) best_ = part;
  }

  const std::vector<bool>& is_filled_;
  PartOfGrid& best_;
};

}  // namespace

ViewIndex PartOfGrid::in_whole(ViewIndex view) const {
  return {first.v + view.v * step, first.u + view.u * step};
}

std::optional<ViewIndex> PartOfGrid::in_part(ViewIndex view) const {
  const int v = view.v - first.v;
  const int u = view.u - first.u;
  const bool is_inside =
      v >= 0 && u >= 0 && v % step == 0 && u % step == 0 && v / step < grid.v && u / step < grid.u;
  return is_inside ? std::optional(ViewIndex{v / step, u / step}) : std::nullopt;
}

PartOfGrid largest_filled_part(const std::vector<bool>& is_filled, GridShape whole) {
  PartOfGrid best{whole, {0, 0}, 1, {0, 0}};
  Search search(is_filled, best);
  for (int step = 1; step <= std::max(whole.v, whole.u); ++step) {
    if (steps_in(whole.v, step) * steps_in(whole.u, step) < best.grid.count()) break;
    for (int v = 0; v < std::min(step, whole.v); ++v) {
      for (int u = 0; u < std::min(step, whole.u); ++u) search.look(step, {v, u});
    }
  }
  return best;
}

}  // namespace episcope::io
