// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/resampled_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace episcope::io {
namespace {

constexpr int kMostTimes = 8;

/// How many times `small` both sides of `large` are; 0 if it is no small whole number.
int times_of(int large_height, int large_width, int small_height, int small_width) {
  const int times = small_height > 0 ? large_height / small_height : 0;
  const bool is_whole = times > 1 && times <= kMostTimes && large_height == times * small_height &&
                        large_width == times * small_width;
  return is_whole ? times : 0;
}

DisparityField empty_like(const DisparityField& field, int height, int width) {
  const ViewStack<float>& maps = field.disparity;
  return {ViewStack<float>(maps.grid(), height, width, 1, maps.first()),
          ViewStack<std::uint8_t>(maps.grid(), height, width, 1, maps.first())};
}

/// Calls `set(view of the result, y, x)` for all pixels, with the map of the view.
template <class Set>
void for_pixels(const DisparityField& field, DisparityField& result, const Set& set) {
  const ViewStack<float>& out = result.disparity;
  for (int i = 0; i < out.grid().count(); ++i) {
    const ViewIndex view = out.grid().view_at(i, out.first());
    const DisparityView map = field.view(view);
    for (int y = 0; y < out.height(); ++y) {
      for (int x = 0; x < out.width(); ++x) set(map, view, y, x);
    }
  }
}

DisparityField reduced(const DisparityField& field, int times) {
  const ViewStack<float>& maps = field.disparity;
  DisparityField result = empty_like(field, maps.height() / times, maps.width() / times);
  std::vector<float> values;
  for_pixels(field, result, [&](const DisparityView& map, ViewIndex view, int y, int x) {
    values.clear();
    for (int i = 0; i < times * times; ++i) {
      const int from_y = times * y + i / times;
      const int from_x = times * x + i % times;
      if (map.is_valid(from_y, from_x)) values.push_back(map.disparity.at(from_y, from_x));
    }
    result.valid.view(view).at(y, x) = values.empty() ? 0 : 1;
    if (values.empty()) return;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    result.disparity.view(view).at(y, x) = *middle;
  });
  return result;
}

DisparityField enlarged(const DisparityField& field, int times) {
  const ViewStack<float>& maps = field.disparity;
  DisparityField result = empty_like(field, maps.height() * times, maps.width() * times);
  for_pixels(field, result, [&](const DisparityView& map, ViewIndex view, int y, int x) {
    const bool is_there = map.is_valid(y / times, x / times);
    result.valid.view(view).at(y, x) = is_there ? 1 : 0;
    if (is_there) result.disparity.view(view).at(y, x) = map.disparity.at(y / times, x / times);
  });
  return result;
}

}  // namespace

ResampledMaps resample_to(DisparityField& field, int height, int width) {
  const int map_height = field.disparity.height();
  const int map_width = field.disparity.width();
  const std::string size = fmt::format("{}×{} px", map_width, map_height);
  if (const int times = times_of(map_height, map_width, height, width)) {
    field = reduced(field, times);
    return {static_cast<double>(times),
            fmt::format("Maps of {}, {} times the size of the views, were reduced: of the values "
                        "in each pixel the median counts.",
                        size, times)};
  }
  if (const int times = times_of(height, width, map_height, map_width)) {
    field = enlarged(field, times);
    return {1.0 / times, fmt::format("Maps of {}, a part of {} of the size of the views, were "
                                     "enlarged: each value stands for {}×{} pixels.",
                                     size, fmt::format("1/{}", times), times, times)};
  }
  return {};
}

}  // namespace episcope::io
