// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/lists_by_motion.h"

#include "engine/io/arrays/array_preview.h"
#include "engine/io/order/list_layout.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace episcope::io {
namespace {

constexpr double kMostPixels = 16e6;  ///< That are looked at, of all views.
constexpr int kLargestWindow = 256;

ListLayout look_at(const ArrayInput& array, const ArrayLayout& list) {
  const int count = list.grid().count();
  std::vector<ViewIndex> views;
  for (int i = 0; i < count; ++i) views.push_back({0, i});
  const int side = std::min(kLargestWindow, static_cast<int>(std::sqrt(kMostPixels / count)));
  const std::vector<Image<float>> windows = array_windows(array, list, views, side);
  return find_list_layout(
      count, [&](int i) { return windows[static_cast<std::size_t>(i)]; }, Progress());
}

}  // namespace

std::optional<ArrayLayout> list_by_motion(const ArrayFile& file, const ArrayEntry& entry,
                                          const std::vector<ArrayLayout>& layouts) {
  const bool are_lists =
      std::ranges::all_of(layouts, [](const ArrayLayout& each) { return each.has('n'); });
  if (!are_lists) return std::nullopt;
  const std::unique_ptr<ArrayInput> array = file.open(entry);
  std::vector<ArrayLayout> grids;
  std::vector<ArrayLayout> lines;
  for (const ArrayLayout& layout : layouts) {
    const ListLayout found = look_at(*array, layout);
    if (!found.is_decided) continue;
    if (found.grid.v > 1 && found.grid.u > 1) {
      grids.push_back(layout);
    } else if (layout.grid().count() < std::min(layout.height(), layout.width())) {
      lines.push_back(layout);
    }
  }
  const std::vector<ArrayLayout>& best = grids.empty() ? lines : grids;
  return best.size() == 1 ? std::optional(best.front()) : std::nullopt;
}

}  // namespace episcope::io
