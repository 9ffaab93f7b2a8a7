// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/filled_views.h"

#include "engine/io/open/grid_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope::io {
namespace {

/// Dark views that hang together with a dark corner of the grid, by sides or corners.
class OuterViews {
 public:
  explicit OuterViews(const ViewBrightness& brightness)
      : grid_(brightness.cells.grid()), is_outer_(static_cast<std::size_t>(grid_.count())) {
    std::vector<ViewIndex> next;
    for (const int v : {0, grid_.v - 1}) {
      for (const int u : {0, grid_.u - 1}) {
        if (take({v, u}, brightness)) {
          next.push_back({v, u});
          ++dark_corners_;
        }
      }
    }
    while (!next.empty()) {
      const ViewIndex view = next.back();
      next.pop_back();
      for (int v = view.v - 1; v <= view.v + 1; ++v) {
        for (int u = view.u - 1; u <= view.u + 1; ++u) {
          if (grid_.contains({v, u}) && take({v, u}, brightness)) next.push_back({v, u});
        }
      }
    }
  }

  [[nodiscard]] int dark_corners() const { return dark_corners_; }
  [[nodiscard]] bool has_any_in(const ViewCrop& crop) const {
    for (int i = 0; i < crop.kept.count(); ++i) {
      if (is_outer_[index(crop.kept.view_at(i, crop.first))]) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] std::size_t index(ViewIndex view) const {
    return static_cast<std::size_t>(view.v) * static_cast<std::size_t>(grid_.u) +
           static_cast<std::size_t>(view.u);
  }
  /// Whether a view is dark and was not taken before.
  bool take(ViewIndex view, const ViewBrightness& brightness) {
    if (is_outer_[index(view)] || brightness.is_filled(view)) return false;
    is_outer_[index(view)] = true;
    return true;
  }

  GridShape grid_;
  std::vector<bool> is_outer_;
  int dark_corners_ = 0;
};

}  // namespace

ViewCrop filled_crop(const ViewBrightness& brightness) {
  const GridShape stored = brightness.cells.grid();
  const ViewCrop all = central_crop(stored, stored);
  const OuterViews outer(brightness);
  if (outer.dark_corners() < 2) return all;
  const auto shorter = [](int length, int by) { return length == 1 ? 1 : length - by; };
  for (int by = 0;; ++by) {
    const GridShape kept{shorter(stored.v, by), shorter(stored.u, by)};
    const bool is_line = stored.v == 1 || stored.u == 1;
    if (std::min(kept.v, kept.u) < (is_line ? 1 : 2) || kept.count() < 2) return all;
    const ViewCrop crop = central_crop(stored, kept);
    if (!outer.has_any_in(crop)) return crop;
  }
}

std::string crop_text(const ViewCrop& crop, const ViewBrightness& brightness) {
  double sum = 0;
  int count = 0;
  for (int i = 0; i < crop.stored.count(); ++i) {
    const ViewIndex view = crop.stored.view_at(i);
    const bool is_kept = crop.kept.contains({view.v - crop.first.v, view.u - crop.first.u});
    if (is_kept || brightness.is_filled(view)) continue;
    sum += brightness.relative(view);
    ++count;
  }
  return fmt::format(
      "{} of {} views kept, rows {} to {} and columns {} to {} from 0: {} outer views are dark "
      "(mean "
      "{} % of the centre's); --crop all keeps them.",
      grid_text(crop.kept), grid_text(crop.stored), crop.first.v, crop.first.v + crop.kept.v - 1,
      crop.first.u, crop.first.u + crop.kept.u - 1, count,
      std::lround(100 * sum / std::max(count, 1)));
}

}  // namespace episcope::io
