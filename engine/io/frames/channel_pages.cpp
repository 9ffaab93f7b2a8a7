// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/frames/channel_pages.h"

#include "engine/io/arrays/array_parallax.h"
#include "engine/io/order/warp_check.h"

#include <algorithm>
#include <utility>

namespace episcope::io {
namespace {

constexpr int kChannels = 3;
constexpr int kFewestViews = 4;

/// Whether pages in the middle of the list differ by colour, not by motion: motion that is too far
/// to be followed leaves pictures that are not alike.
bool are_channels(const LightField::Samples& samples, const PageOrder& order, int views) {
  constexpr double kAlike = 0.4;
  const int middle = views / 2;
  const auto picture = [&](int view, int channel) {
    return MotionPictures(grey_levels(samples, {0, order.page(view, channel)}));
  };
  const MotionPictures center = picture(middle, 1);
  AxisEvidence of_channels;
  AxisEvidence of_views;
  for (const int side : {-1, 1}) {
    const MotionPictures other = picture(middle, 1 + side);
    if (correlation(center.scales[1], other.scales[1]) < kAlike) return false;
    of_channels.add(center, other);
    if (middle + side < views) of_views.add(center, picture(middle + side, 1));
  }
  return are_rather_channels(of_channels, of_views);
}

template <class T>
ViewStack<T> joined(const ViewStack<T>& pages, const PageOrder& order) {
  const int views = pages.grid().count() / order.channels;
  ViewStack<T> coloured({1, views}, pages.height(), pages.width(), kChannels, {},
                        allocate_large_zeros);
  for (int view = 0; view < views; ++view) {
    for (int channel = 0; channel < std::min(order.channels, kChannels); ++channel) {
      const T* from = pages.view({0, order.page(view, channel)}).data;
      T* to = coloured.view({0, view}).data + channel;
      for (std::size_t n = 0; n < pages.view_size(); ++n) to[n * kChannels] = from[n];
    }
  }
  return coloured;
}

}  // namespace

std::optional<PageOrder> find_channel_pages(const LightField::Samples& samples) {
  return std::visit(
      [&](const auto& stack) -> std::optional<PageOrder> {
        const int pages = stack.grid().count();
        const int views = pages / kChannels;
        const bool may_be = stack.channels() == 1 && pages % kChannels == 0;
        if (!may_be || views < kFewestViews) return std::nullopt;
        for (const PageOrder& order : {PageOrder{kChannels, 1}, PageOrder{kChannels, views}}) {
          if (are_channels(samples, order, views)) return order;
        }
        return std::nullopt;
      },
      samples);
}

void join_channel_pages(LightField::Samples& samples, const PageOrder& order) {
  std::visit([&](auto& stack) { stack = joined(stack, order); }, samples);
}

}  // namespace episcope::io
