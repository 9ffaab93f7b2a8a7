// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/dark_views.h"

#include "engine/core/finding.h"
#include "engine/core/memory.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/io/base/sample_range.h"
#include "engine/io/models/open_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <type_traits>
#include <vector>

namespace episcope::io {
namespace {

constexpr int kCellsAcross = 20;
constexpr int kSmallestCell = 8;
constexpr int kPixelStep = 2;
constexpr int kGuard = 3;  ///< Cells around one, on each side.
constexpr float kEmpty = 0.1F;
constexpr float kDarkest = 0.02F;  ///< About what black is in noisy photographs.
constexpr double kFilled = 0.5;
constexpr double kMostEmpty = 0.25;

template <class T>
constexpr float unit() {
  return std::is_integral_v<T> ? 1.0F / static_cast<float>(std::numeric_limits<T>::max()) : 1.0F;
}

template <class T>
float sum_of(const T* pixel, int channels) {
  float sum = 0;
  for (int c = 0; c < channels; ++c) sum += static_cast<float>(pixel[c]);
  return std::isfinite(sum) ? sum : 0;
}

/// Every other row, or one through the middle of each row of cells.
std::vector<int> looked_at(int height, int cell_rows, BrightnessRows wanted) {
  std::vector<int> rows;
  if (wanted == BrightnessRows::Few) {
    for (int row = 0; row < cell_rows; ++row)
      rows.push_back((2 * row + 1) * height / (2 * cell_rows));
  } else {
    for (int y = 0; y < height; y += kPixelStep) rows.push_back(y);
  }
  return rows;
}

/// Has the disk read them together rather than one after the other.
template <class T>
void fetch_rows(const ViewStack<T>& stack, const std::vector<int>& rows) {
  if (!stack.is_on_disk()) return;
  for (int i = 0; i < stack.grid().count(); ++i) {
    const ImageView<const T> view = stack.view(stack.view_at(i));
    const std::size_t bytes = sizeof(T) * view.width * view.channels;
    for (const int y : rows) fetch_pages(view.row(y), bytes);
  }
}

/// `valid` may be empty.
template <class T>
void measure(ImageView<const T> view, ImageView<const std::uint8_t> valid,
             const std::vector<int>& rows, ImageView<float> cells) {
  std::vector<float> sums(cells.size());
  std::vector<int> counts(cells.size());
  for (const int y : rows) {
    const int row = y * cells.height / view.height;
    for (int x = 0; x < view.width; x += kPixelStep) {
      const std::size_t cell =
          static_cast<std::size_t>(row) * cells.width + x * cells.width / view.width;
      ++counts[cell];
      if (valid.empty() || valid.at(y, x) != 0) {
        sums[cell] += sum_of(view.row(y) + x * view.channels, view.channels);
      }
    }
  }
  const float scale = unit<T>() / static_cast<float>(view.channels);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    cells.data[i] = counts[i] > 0 ? scale * sums[i] / static_cast<float>(counts[i]) : 0;
  }
}

Image<float> median_of_the_middle(const ViewStack<float>& cells) {
  const GridShape grid = cells.grid();
  const ViewIndex center = grid.center();
  Image<float> median(cells.height(), cells.width());
  std::vector<float> values;
  for (int i = 0; i < static_cast<int>(median.size()); ++i) {
    values.clear();
    for (int v = center.v - 1; v <= center.v + 1; ++v) {
      for (int u = center.u - 1; u <= center.u + 1; ++u) {
        if (grid.contains({v, u})) values.push_back(cells.view({v, u}).data[i]);
      }
    }
    median.data()[i] = quantile(values, 0.5);
  }
  return median;
}

Image<float> least_around(const Image<float>& reference) {
  Image<float> least(reference.height(), reference.width());
  for (int y = 0; y < least.height(); ++y) {
    for (int x = 0; x < least.width(); ++x) {
      float value = reference.at(y, x);
      for (int j = std::max(y - kGuard, 0); j <= std::min(y + kGuard, least.height() - 1); ++j) {
        for (int i = std::max(x - kGuard, 0); i <= std::min(x + kGuard, least.width() - 1); ++i) {
          value = std::min(value, reference.at(j, i));
        }
      }
      least.at(y, x) = value;
    }
  }
  return least;
}

double mean(ImageView<const float> cells) {
  double sum = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) sum += cells.data[i];
  return sum / static_cast<double>(cells.size());
}

}  // namespace

bool ViewBrightness::is_empty(ViewIndex view, int row, int column) const {
  const float least = expected.at(row, column);
  return least > kDarkest && cells.view(view).at(row, column) < kEmpty * least;
}

double ViewBrightness::relative(ViewIndex view) const {
  const double middle = mean(reference.view());
  return middle > 0 ? mean(cells.view(view)) / middle : 1;
}

bool ViewBrightness::is_filled(ViewIndex view) const {
  if (mean(reference.view()) < kDarkest) return true;  // too dark to tell
  int empty = 0;
  for (int row = 0; row < cells.height(); ++row) {
    for (int column = 0; column < cells.width(); ++column) {
      empty += is_empty(view, row, column) ? 1 : 0;
    }
  }
  return relative(view) >= kFilled && empty <= kMostEmpty * static_cast<double>(cells.view_size());
}

bool ViewBrightness::has_dark_parts() const {
  for (int i = 0; i < cells.grid().count(); ++i) {
    const ViewIndex view = cells.view_at(i);
    if (!is_filled(view)) return true;
    for (int n = 0; n < static_cast<int>(cells.view_size()); ++n) {
      if (is_empty(view, n / cells.width(), n % cells.width())) return true;
    }
  }
  return false;
}

ViewBrightness measure_brightness(const LightField::Samples& samples,
                                  const ViewStack<std::uint8_t>& valid, BrightnessRows wanted,
                                  const Progress& progress) {
  ViewBrightness found;
  std::visit(
      [&](const auto& stack) {
        const int cell =
            std::max(std::min(stack.height(), stack.width()) / kCellsAcross, kSmallestCell);
        found.cells = ViewStack<float>(stack.grid(), std::max(stack.height() / cell, 1),
                                       std::max(stack.width() / cell, 1));
        const std::vector<int> rows = looked_at(stack.height(), found.cells.height(), wanted);
        if (wanted == BrightnessRows::Few) fetch_rows(stack, rows);
        parallel_for(stack.grid().count(), progress, [&](int i) {
          const ViewIndex view = stack.view_at(i);
          measure(stack.view(view),
                  valid.empty() ? ImageView<const std::uint8_t>() : valid.view(view), rows,
                  found.cells.view(view));
        });
      },
      samples);
  found.reference = median_of_the_middle(found.cells);
  found.expected = least_around(found.reference);
  return found;
}

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
  return fmt::format(finding_text("crop.dark"), grid_text(crop.kept), grid_text(crop.stored),
                     crop.first.v, crop.first.v + crop.kept.v - 1, crop.first.u,
                     crop.first.u + crop.kept.u - 1, count,
                     std::lround(100 * sum / std::max(count, 1)));
}

namespace {

/// Between the centers of which two cells a pixel lies, and how far from the first.
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
  if (valid.empty()) valid = all_valid(grid, height, width);
  std::vector<long long> marked(views.size());
  parallel_for(static_cast<int>(views.size()), progress, [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    marked[index] =
        mark(brightness.cells.view(views[index]), brightness.expected, valid.view(views[index]));
  });
  const long long total = std::accumulate(marked.begin(), marked.end(), 0LL);
  if (total == 0) return {};
  return fmt::format(finding_text("valid.dark"),
                     100.0 * static_cast<double>(total) / static_cast<double>(valid.size()),
                     views.size(), grid.count());
}

namespace {

constexpr double kBlack = 0.004;       ///< One grey level of 255, with rounding.
constexpr double kNearlyBlack = 0.02;  ///< In views that were interpolated.
constexpr double kLongestWedge = 0.3;
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

struct ViewCorner {
  bool is_bottom = false;
  bool is_right = false;
};

/// Pixels of the black wedge at a corner: row by row from the corner, runs from the side that do
/// not grow. Empty if it is too small, or too long to be one.
template <class T>
std::vector<PixelIndex> wedge_at(ImageView<const T> view, ViewCorner corner) {
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
    if (run > kLongestWedge * view.width || (run > 0 && j > kLongestWedge * view.height)) return {};
  }
  const double area = static_cast<double>(view.height) * view.width;
  if (static_cast<double>(pixels.size()) < kSmallest * area) return {};
  return pixels;
}

/// Of the center view; empty where fewer than three corners are black.
template <class T>
std::vector<PixelIndex> black_wedges(ImageView<const T> center) {
  std::vector<PixelIndex> all;
  int corners = 0;
  for (const ViewCorner corner : {ViewCorner{false, false}, ViewCorner{false, true},
                                  ViewCorner{true, false}, ViewCorner{true, true}}) {
    const std::vector<PixelIndex> wedge = wedge_at(center, corner);
    corners += wedge.empty() ? 0 : 1;
    all.insert(all.end(), wedge.begin(), wedge.end());
  }
  if (corners < kFewestCorners) all.clear();
  return all;
}

/// Of the pixels of wedges those that are not dark and hang together with pixels beside the wedges:
/// what dark ones enclose is noise.
template <class IsDark>
Image<std::uint8_t> seen_in(const Image<std::uint8_t>& is_wedge, const IsDark& is_dark) {
  const int height = is_wedge.height(), width = is_wedge.width();
  Image<std::uint8_t> seen(is_wedge.height(), is_wedge.width());
  std::vector<PixelIndex> next;
  const auto visit_neighbors = [&](PixelIndex at, const auto& visit) {
    for (const auto& [dy, dx] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
      const PixelIndex other{at.y + dy, at.x + dx};
      if (other.y >= 0 && other.y < height && other.x >= 0 && other.x < width) visit(other);
    }
  };
  const auto take = [&](PixelIndex at) {
    if (is_wedge.at(at.y, at.x) == 0 || seen.at(at.y, at.x) != 0 || is_dark(at)) return;
    seen.at(at.y, at.x) = 1;
    next.push_back(at);
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (is_wedge.at(y, x) == 0) continue;
      bool is_at_border = false;
      visit_neighbors({y, x}, [&](PixelIndex at) { is_at_border |= is_wedge.at(at.y, at.x) == 0; });
      if (is_at_border) take({y, x});
    }
  }
  while (!next.empty()) {
    const PixelIndex at = next.back();
    next.pop_back();
    visit_neighbors(at, take);
  }
  return seen;
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
  if (valid.empty()) valid = all_valid(grid, views.height(), views.width());
  Image<std::uint8_t> is_wedge(views.height(), views.width());
  for (const PixelIndex at : wedges) is_wedge.at(at.y, at.x) = 1;
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = grid.view_at(i);
    const Image<std::uint8_t> seen =
        seen_in(is_wedge, [&](PixelIndex at) { return is_dark(view, at); });
    for (const PixelIndex at : wedges) {
      if (seen.at(at.y, at.x) == 0) valid.view(view).at(at.y, at.x) = 0;
    }
  });
  return fmt::format(finding_text("valid.corners"),
                     100.0 * static_cast<double>(total) / static_cast<double>(valid.size()));
}

}  // namespace

std::string mark_black_corners(const LightField::Samples& samples, ViewStack<std::uint8_t>& valid,
                               const Progress& progress) {
  return std::visit([&](const auto& views) { return mark(views, valid, progress); }, samples);
}

}  // namespace episcope::io
