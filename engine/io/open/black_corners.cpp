// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/black_corners.h"

#include "engine/core/parallel/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <type_traits>
#include <vector>

namespace episcope::io {
namespace {

constexpr double kBlack = 0.004;       ///< One grey level of 255, with rounding.
constexpr double kNearlyBlack = 0.02;  ///< In views that were interpolated.
constexpr double kLongest = 0.3;
constexpr double kSmallest = 0.0005;  ///< Of the area of a view.
constexpr int kFewestCorners = 3;
constexpr double kShared = 0.8;

template <class T>
bool is_black(const T* pixel, int channels, double limit) {
  constexpr double kFull =
      std::is_integral_v<T> ? static_cast<double>(std::numeric_limits<T>::max()) : 1.0;
  return std::all_of(pixel, pixel + channels,
                     [&](T sample) { return static_cast<double>(sample) <= limit * kFull; });
}

struct Corner {
  bool is_bottom = false;
  bool is_right = false;
};

/// Pixels of the black wedge at a corner: row by row from the corner, runs from the side that do
/// not grow. Empty if it is too small, or too long to be one.
template <class T>
std::vector<PixelIndex> wedge_at(ImageView<const T> view, Corner corner) {
  std::vector<PixelIndex> pixels;
  int longest = view.width;
  for (int j = 0; j < view.height && longest > 0; ++j) {
    const int y = corner.is_bottom ? view.height - 1 - j : j;
    const auto x_at = [&](int i) { return corner.is_right ? view.width - 1 - i : i; };
    int run = 0;
    while (run < longest &&
           is_black(view.row(y) + x_at(run) * view.channels, view.channels, kBlack)) {
      pixels.push_back({y, x_at(run++)});
    }
    longest = run;
    if (run > kLongest * view.width || (run > 0 && j > kLongest * view.height)) return {};
  }
  const double area = static_cast<double>(view.height) * view.width;
  if (static_cast<double>(pixels.size()) < kSmallest * area) return {};
  return pixels;
}

/// Of the centre view; empty where fewer than three corners are black.
template <class T>
std::vector<PixelIndex> black_wedges(ImageView<const T> center) {
  std::vector<PixelIndex> all;
  int corners = 0;
  for (const Corner corner :
       {Corner{false, false}, Corner{false, true}, Corner{true, false}, Corner{true, true}}) {
    const std::vector<PixelIndex> wedge = wedge_at(center, corner);
    corners += wedge.empty() ? 0 : 1;
    all.insert(all.end(), wedge.begin(), wedge.end());
  }
  if (corners < kFewestCorners) all.clear();
  return all;
}

template <class T>
std::string mark(const ViewStack<T>& views, ViewStack<std::uint8_t>& valid,
                 const Progress& progress) {
  const GridShape grid = views.grid();
  const std::vector<PixelIndex> wedges = black_wedges(views.view(grid.center()));
  if (wedges.empty()) return {};
  const auto is_dark = [&](ViewIndex view, PixelIndex at) {
    const auto picture = views.view(view);
    return is_black(picture.row(at.y) + at.x * picture.channels, picture.channels, kNearlyBlack);
  };
  std::vector<long long> dark(static_cast<std::size_t>(grid.count()));
  parallel_for(grid.count(), progress, [&](int i) {
    dark[static_cast<std::size_t>(i)] =
        std::ranges::count_if(wedges, [&](PixelIndex at) { return is_dark(grid.view_at(i), at); });
  });
  const long long total = std::accumulate(dark.begin(), dark.end(), 0LL);
  const auto all = static_cast<double>(wedges.size()) * grid.count();
  if (static_cast<double>(total) < kShared * all) return {};
  if (valid.empty()) {
    valid = ViewStack<std::uint8_t>(grid, views.height(), views.width());
    std::fill_n(valid.data(), valid.size(), std::uint8_t{1});
  }
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = grid.view_at(i);
    for (const PixelIndex at : wedges) {
      if (is_dark(view, at)) valid.view(view).at(at.y, at.x) = 0;
    }
  });
  return fmt::format(
      "The corners of the views are black, {:.1f} % of their pixels, as a lens cuts them off; they "
      "are marked as not valid.",
      100.0 * static_cast<double>(total) / static_cast<double>(valid.size()));
}

}  // namespace

std::string mark_black_corners(const LightField::Samples& samples, ViewStack<std::uint8_t>& valid,
                               const Progress& progress) {
  return std::visit([&](const auto& views) { return mark(views, valid, progress); }, samples);
}

}  // namespace episcope::io
