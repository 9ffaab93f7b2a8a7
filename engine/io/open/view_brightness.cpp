// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/view_brightness.h"

#include "engine/core/array/mapped_memory.h"
#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

namespace episcope::io {
namespace {

constexpr int kCellsAcross = 20;
constexpr int kSmallestCell = 8;
constexpr int kStep = 2;
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
    for (int y = 0; y < height; y += kStep) rows.push_back(y);
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
    for (int x = 0; x < view.width; x += kStep) {
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
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    median.data()[i] = *middle;
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

}  // namespace episcope::io
