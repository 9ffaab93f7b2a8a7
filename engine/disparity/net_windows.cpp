// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/net_windows.h"

#include "engine/core/parallel.h"

#include <algorithm>

namespace episcope {

namespace {

template <class Better>
Image<float> window_extreme(const Image<float>& map, int size, const Better& better,
                            const Progress& progress) {
  const int radius = size / 2, width = map.width();
  Image<float> found(map.height(), width);
  parallel_for(map.height(), progress, [&](int y) {
    std::vector<float> column(map.row(y), map.row(y) + width);
    for (int i = std::max(y - radius, 0); i < std::min(y + radius + 1, map.height()); ++i) {
      for (int x = 0; x < width; ++x) column[x] = better(column[x], map.row(i)[x]);
    }
    for (int x = 0; x < width; ++x) {
      float best = column[x];
      for (int i = std::max(x - radius, 0); i < std::min(x + radius + 1, width); ++i) {
        best = better(best, column[i]);
      }
      found.at(y, x) = best;
    }
  });
  return found;
}

}  // namespace

Image<float> window_most(const Image<float>& map, int size, const Progress& progress) {
  return window_extreme(
      map, size, [](float a, float b) { return std::max(a, b); }, progress);
}

Image<float> window_least(const Image<float>& map, int size, const Progress& progress) {
  return window_extreme(
      map, size, [](float a, float b) { return std::min(a, b); }, progress);
}

Image<float> window_median(const Image<float>& map, int apart, const Progress& progress) {
  constexpr int kRadius = kNetWindow / 2;
  Image<float> found(map.height(), map.width());
  parallel_for(map.height(), progress, [&](int y) {
    const float* rows[kNetWindow];
    for (int i = 0; i < kNetWindow; ++i) {
      rows[i] = map.row(std::clamp(y + (i - kRadius) * apart, 0, map.height() - 1));
    }
    std::array<float, kNetWindow * kNetWindow> window;
    for (int x = 0; x < map.width(); ++x) {
      int count = 0;
      for (int j = -kRadius; j <= kRadius; ++j) {
        const int column = std::clamp(x + j * apart, 0, map.width() - 1);
        for (const float* const row : rows) window[count++] = row[column];
      }
      std::nth_element(window.begin(), window.begin() + count / 2, window.end());
      found.at(y, x) = window[count / 2];
    }
  });
  return found;
}

std::array<Image<float>, kNetHypotheses> net_hypotheses(const Image<float>& map,
                                                        const Image<float>& second,
                                                        const Progress& progress) {
  const Image<float> median = window_median(map, 1, progress.part(0, 0.3));
  return {map,
          window_most(map, kNetWindow, progress.part(0.3, 0.4)),
          window_least(map, kNetWindow, progress.part(0.4, 0.5)),
          median,
          window_most(median, kNetWideWindow, progress.part(0.5, 0.6)),
          window_least(median, kNetWideWindow, progress.part(0.6, 0.7)),
          window_median(map, kNetMedianApart, progress.part(0.7, 1)),
          second};
}

}  // namespace episcope
