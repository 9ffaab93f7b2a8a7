// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/frames/channel_pages.h"

#include "engine/io/arrays/array_parallax.h"
#include "engine/io/order/warp_check.h"

#include <utility>

namespace episcope::io {
namespace {

constexpr int kChannels = 3;
constexpr int kFewestViews = 4;

/// How far apart the pages of the channels of a view, and those of a channel, are.
struct PageOrder {
  int channel_step = 0;
  int view_step = 0;
  [[nodiscard]] int page(int view, int channel) const {
    return view * view_step + channel * channel_step;
  }
};

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
ViewStack<T> joined(const ViewStack<T>& pages, const PageOrder& order, int views) {
  ViewStack<T> coloured({1, views}, pages.height(), pages.width(), kChannels);
  for (int view = 0; view < views; ++view) {
    for (int channel = 0; channel < kChannels; ++channel) {
      const T* from = pages.view({0, order.page(view, channel)}).data;
      T* to = coloured.view({0, view}).data + channel;
      for (std::size_t n = 0; n < pages.view_size(); ++n) to[n * kChannels] = from[n];
    }
  }
  return coloured;
}

}  // namespace

bool join_channel_pages(LightField::Samples& samples) {
  return std::visit(
      [&](auto& stack) {
        const int pages = stack.grid().count();
        const int views = pages / kChannels;
        if (stack.channels() != 1 || pages % kChannels != 0 || views < kFewestViews) return false;
        for (const PageOrder& order : {PageOrder{1, kChannels}, PageOrder{views, 1}}) {
          if (!are_channels(samples, order, views)) continue;
          stack = joined(stack, order, views);
          return true;
        }
        return false;
      },
      samples);
}

}  // namespace episcope::io
