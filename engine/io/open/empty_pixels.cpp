// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/empty_pixels.h"

#include "engine/core/parallel/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace episcope::io {
namespace {

constexpr float kEmpty = 0.1F;  // as ViewBrightness::is_empty
constexpr float kDarkest = 0.02F;

/// Between the centres of which two cells a pixel lies, and how far from the first.
struct Between {
  int first = 0;
  int second = 0;
  float part = 0;
};

std::vector<Between> between_cells(int pixels, int cells) {
  std::vector<Between> found(static_cast<std::size_t>(pixels));
  for (int i = 0; i < pixels; ++i) {
    const float place =
        (static_cast<float>(i) + 0.5F) * static_cast<float>(cells) / static_cast<float>(pixels) -
        0.5F;
    const float clamped = std::clamp(place, 0.0F, static_cast<float>(cells - 1));
    const int first = static_cast<int>(clamped);
    found[static_cast<std::size_t>(i)] = {first, std::min(first + 1, cells - 1),
                                          clamped - static_cast<float>(first)};
  }
  return found;
}

float interpolated(ImageView<const float> cells, const Between& y, const Between& x) {
  const auto along = [&](int row) {
    return cells.at(row, x.first) * (1 - x.part) + cells.at(row, x.second) * x.part;
  };
  return along(y.first) * (1 - y.part) + along(y.second) * y.part;
}

bool has_empty_cells(const ViewBrightness& brightness, ViewIndex view) {
  for (int row = 0; row < brightness.cells.height(); ++row) {
    for (int column = 0; column < brightness.cells.width(); ++column) {
      if (brightness.is_empty(view, row, column)) return true;
    }
  }
  return false;
}

/// Returns how many pixels were marked that had been valid.
long long mark(ImageView<const float> cells, const Image<float>& expected,
               ImageView<std::uint8_t> valid) {
  const std::vector<Between> rows = between_cells(valid.height, cells.height);
  const std::vector<Between> columns = between_cells(valid.width, cells.width);
  long long marked = 0;
  for (int y = 0; y < valid.height; ++y) {
    const Between& row = rows[static_cast<std::size_t>(y)];
    for (int x = 0; x < valid.width; ++x) {
      const Between& column = columns[static_cast<std::size_t>(x)];
      const float least = interpolated(expected.view(), row, column);
      if (least <= kDarkest || interpolated(cells, row, column) >= kEmpty * least) continue;
      marked += valid.at(y, x) != 0 ? 1 : 0;
      valid.at(y, x) = 0;
    }
  }
  return marked;
}

}  // namespace

std::string mark_empty_pixels(const ViewBrightness& brightness, int height, int width,
                              ViewStack<std::uint8_t>& valid, const Progress& progress) {
  const GridShape grid = brightness.cells.grid();
  std::vector<ViewIndex> views;
  for (int i = 0; i < grid.count(); ++i) {
    if (has_empty_cells(brightness, grid.view_at(i))) views.push_back(grid.view_at(i));
  }
  if (views.empty()) return {};
  if (valid.empty()) {
    valid = ViewStack<std::uint8_t>(grid, height, width);
    std::fill_n(valid.data(), valid.size(), std::uint8_t{1});
  }
  std::vector<long long> marked(views.size());
  parallel_for(static_cast<int>(views.size()), progress, [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    marked[index] =
        mark(brightness.cells.view(views[index]), brightness.expected, valid.view(views[index]));
  });
  const long long total = std::accumulate(marked.begin(), marked.end(), 0LL);
  if (total == 0) return {};
  return fmt::format(
      "{:.1f} % of all pixels, in {} of {} views, are dark where the centre view is not; they are "
      "marked as not valid.",
      100.0 * static_cast<double>(total) / static_cast<double>(valid.size()), views.size(),
      grid.count());
}

}  // namespace episcope::io
