// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/live/live_part.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace episcope {
namespace {

// Filters, windows and tensors look no farther, px.
constexpr int kSupport = 16;
// A part that takes more of the view than this is not worth being cut out.
constexpr double kMostOfView = 0.6;

PixelRect whole(const LightField& lf) {
  return {0, 0, lf.height(), lf.width()};
}

double area(const PixelRect& rect) {
  return static_cast<double>(rect.y1 - rect.y0) * (rect.x1 - rect.x0);
}

int steps_to_farthest(int extent, std::optional<int> from) {
  return from ? std::max(*from, extent - 1 - *from) : extent - 1;
}

struct Pasting {
  LivePart part;
  int factor = 1;
  ViewIndex first{};
  GridShape grid{};
  int height = 0;
  int width = 0;
};

// Each value `scale` times as large, `outside` where there is none.
template <class T>
ViewStack<T> pasted(const ViewStack<T>& from, const Pasting& place, T scale, T outside) {
  if (from.empty()) return {};
  ViewStack<T> to(place.grid, place.height, place.width, 1, place.first);
  std::fill_n(to.data(), to.size(), outside);
  const auto& [wanted, read] = place.part;
  for (int i = 0; i < place.grid.count(); ++i) {
    const auto source = from.view(to.view_at(i));
    const auto target = to.view(to.view_at(i));
    for (int y = wanted.y0; y < wanted.y1; ++y) {
      const T* row = source.row(std::min((y - read.y0) / place.factor, source.height - 1));
      for (int x = wanted.x0; x < wanted.x1; ++x) {
        target.at(y, x) = scale * row[std::min((x - read.x0) / place.factor, source.width - 1)];
      }
    }
  }
  return to;
}

// 1 wherever there is a value.
ViewStack<std::uint8_t> all_valid(const ViewStack<float>& values) {
  ViewStack<std::uint8_t> ones(values.grid(), values.height(), values.width(), 1, values.first());
  std::fill_n(ones.data(), ones.size(), std::uint8_t{1});
  return ones;
}

DisparityField pasted(const DisparityField& from, const Pasting& place) {
  if (from.empty()) return {};
  const auto valid = from.valid.empty() ? all_valid(from.disparity) : from.valid.clone();
  DisparityField to;
  to.disparity = pasted(from.disparity, place, static_cast<float>(place.factor), 0.0F);
  to.valid = pasted<std::uint8_t>(valid, place, 1, 0);
  return to;
}

}  // namespace

LivePart live_part(const LightField& lf, const PixelRect& wanted, Interval range,
                   std::optional<ViewIndex> view) {
  const PixelRect all = whole(lf);
  if (wanted.empty()) return {all, all};
  const double reach = std::max(std::abs(range.min), std::abs(range.max));
  const auto margin = [reach](int steps) {
    return static_cast<int>(std::ceil(reach * steps)) + kSupport;
  };
  const int down =
      margin(steps_to_farthest(lf.grid().v, view ? std::optional(view->v) : std::nullopt));
  const int across =
      margin(steps_to_farthest(lf.grid().u, view ? std::optional(view->u) : std::nullopt));
  const PixelRect inside{std::max(wanted.y0, 0), std::max(wanted.x0, 0),
                         std::min(wanted.y1, lf.height()), std::min(wanted.x1, lf.width())};
  const PixelRect read{std::max(inside.y0 - down, 0) / kLiveFactor * kLiveFactor,
                       std::max(inside.x0 - across, 0) / kLiveFactor * kLiveFactor,
                       std::min(inside.y1 + down, lf.height()),
                       std::min(inside.x1 + across, lf.width())};
  if (inside.empty() || area(read) > kMostOfView * area(all)) return {all, all};
  return {inside, read};
}

Estimate in_whole_views(const Estimate& estimate, const LivePart& part, int factor,
                        const LightField& lf, std::optional<ViewIndex> view) {
  const ViewStack<float>& from = estimate.field.disparity;
  const Pasting place{
      part,        factor,    view ? *view : from.first(), view ? GridShape{1, 1} : from.grid(),
      lf.height(), lf.width()};
  Estimate whole_views;
  whole_views.set_provenance(estimate.provenance());
  whole_views.range = {factor * estimate.range.min, factor * estimate.range.max};
  whole_views.field = pasted(estimate.field, place);
  whole_views.confidence = pasted(estimate.confidence, place, 1.0F, 0.0F);
  whole_views.layered.foreground = pasted(estimate.layered.foreground, place);
  whole_views.layered.background = pasted(estimate.layered.background, place);
  whole_views.layered.layers =
      pasted<std::uint8_t>(estimate.layered.layers, place, std::uint8_t{1}, std::uint8_t{0});
  return whole_views;
}

}  // namespace episcope
