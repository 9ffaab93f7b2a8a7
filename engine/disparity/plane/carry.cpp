// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/carry.h"

#include "engine/core/error.h"
#include "engine/core/parallel/parallel.h"
#include "engine/disparity/common/surfaces_in_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace episcope {
namespace {

// Values of one surface differ by less, px.
constexpr float kOneSurface = 0.15F;
constexpr float kLeastVote = 0.02F;
constexpr float kClearly = 1.001F;
constexpr float kNone = std::numeric_limits<float>::infinity();

// A view while it is filled; kNothingNear where nothing is known.
struct Target {
  ImageView<float> disparity, confidence;
  float nearness = 1;  // of the map that is shown: the nearer, the better it knows silhouettes
};

float nearness_of(ViewIndex from, ViewIndex to) {
  return 1 / static_cast<float>(1 + std::abs(to.v - from.v) + std::abs(to.u - from.u));
}

void take(ImageView<const float> from, ImageView<float> to) {
  for (int y = 0; y < to.height; ++y) std::copy_n(from.row(y), to.width, to.row(y));
}

// A pixel without a value between two that belong to one surface, along either axis.
void close_cracks(const Target& out) {
  const ImageView<float> map = out.disparity;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (map.at(y, x) > kNothingNear) continue;
      const auto close = [&](PixelIndex a, PixelIndex b) {
        if (a.y < 0 || a.x < 0 || b.y >= map.height || b.x >= map.width) return;
        const float one = map.at(a.y, a.x), two = map.at(b.y, b.x);
        if (one <= kNothingNear || two <= kNothingNear || std::abs(one - two) > kOneSurface) return;
        map.at(y, x) = 0.5F * (one + two);
        out.confidence.at(y, x) =
            0.5F * (out.confidence.at(a.y, a.x) + out.confidence.at(b.y, b.x));
      };
      close({y, x - 1}, {y, x + 1});
      if (map.at(y, x) <= kNothingNear) close({y - 1, x}, {y + 1, x});
    }
  }
}

// What a map shows in another view.
void cast(const Estimate& map, ViewIndex to, const Target& out) {
  const ViewIndex from = map.field.disparity.first();
  const ImageView<const float> disparity = map.field.disparity.view(from);
  const ImageView<const float> confidence = map.confidence.view(from);
  if (from == to) {
    take(disparity, out.disparity);
    return take(confidence, out.confidence);
  }
  std::fill_n(out.disparity.data, out.disparity.size(), kNothingNear);
  const auto v = static_cast<float>(to.v - from.v), u = static_cast<float>(to.u - from.u);
  for (int y = 0; y < disparity.height; ++y) {
    for (int x = 0; x < disparity.width; ++x) {
      const float d = disparity.at(y, x);
      const auto row = static_cast<int>(std::lround(static_cast<float>(y) - d * v));
      const auto column = static_cast<int>(std::lround(static_cast<float>(x) - d * u));
      if (row < 0 || column < 0 || row >= disparity.height || column >= disparity.width) continue;
      if (out.disparity.at(row, column) >= d) continue;
      out.disparity.at(row, column) = d;
      out.confidence.at(row, column) = confidence.at(y, x);
    }
  }
  close_cracks(out);
}

// The value that most of the maps agree about, by confidence and nearness: the mean of those within
// kOneSurface of it. The first of equals.
void vote(const std::vector<Target>& shown, int y, int x, const Target& out) {
  float best = 0;
  for (const Target& one : shown) {
    const float d = one.disparity.at(y, x);
    if (d <= kNothingNear) continue;
    float sum = 0, weight = 0, support = 0;
    for (const Target& other : shown) {
      const float there = other.disparity.at(y, x);
      if (std::abs(there - d) > kOneSurface) continue;
      const float w = other.nearness * (other.confidence.at(y, x) + kLeastVote);
      weight += w;
      sum += w * there;
      support += w * other.confidence.at(y, x);
    }
    if (weight <= best * kClearly) continue;
    best = weight;
    out.disparity.at(y, x) = sum / weight;
    out.confidence.at(y, x) = support / weight;
  }
}

// Lowers `farthest` to the last known value before each pixel, from one end of a line to the other.
template <class At>
void follow(int count, const At& at) {
  float last = kNone;
  for (int i = 0; i < count; ++i) {
    auto [known, farthest] = at(i);
    if (known > kNothingNear) last = known;
    *farthest = std::min(*farthest, last);
  }
}

void fill(const Target& out) {
  const ImageView<float> map = out.disparity;
  Image<float> farthest(map.height, map.width, 1, kNone);
  const auto along = [&](int count, const auto& place) {
    follow(count, [&](int i) {
      const PixelIndex at = place(i);
      return std::pair(map.at(at.y, at.x), &farthest.at(at.y, at.x));
    });
  };
  for (int y = 0; y < map.height; ++y) {
    along(map.width, [&](int i) { return PixelIndex{y, i}; });
    along(map.width, [&](int i) { return PixelIndex{y, map.width - 1 - i}; });
  }
  for (int x = 0; x < map.width; ++x) {
    along(map.height, [&](int i) { return PixelIndex{i, x}; });
    along(map.height, [&](int i) { return PixelIndex{map.height - 1 - i, x}; });
  }
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (map.at(y, x) > kNothingNear) continue;
      map.at(y, x) = farthest.at(y, x) < kNone ? farthest.at(y, x) : 0;
      out.confidence.at(y, x) = 0;
    }
  }
}

// Fills `out`, the view `to`, with what the maps show there.
void carry(const std::vector<Estimate>& maps, ViewIndex to, const Target& out) {
  const int height = out.disparity.height, width = out.disparity.width;
  std::fill_n(out.disparity.data, out.disparity.size(), kNothingNear);
  std::vector<Image<float>> images(2 * maps.size(), Image<float>(height, width));
  std::vector<Target> shown;
  for (std::size_t k = 0; k < maps.size(); ++k) {
    shown.push_back({images[2 * k].view(), images[2 * k + 1].view(),
                     nearness_of(maps[k].field.disparity.first(), to)});
    cast(maps[k], to, shown.back());
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) vote(shown, y, x, out);
  }
  if (to == maps.front().field.disparity.first()) cast(maps.front(), to, out);
  fill(out);
}

}  // namespace

CarriedMaps carry_to_views(const std::vector<Estimate>& maps, ViewRectangle views,
                           const Progress& progress) {
  if (maps.empty()) throw InvalidInput("there is no map to carry to other views");
  const ViewStack<float>& map = maps.front().field.disparity;
  const auto stack = [&] {
    return ViewStack<float>(views.grid, map.height(), map.width(), 1, views.first);
  };
  CarriedMaps all{stack(), stack()};
  progress.step("carrying to other views");
  parallel_for(views.grid.count(), progress, [&](int i) {
    const ViewIndex view = views.grid.view_at(i, views.first);
    carry(maps, view, {all.disparity.view(view), all.confidence.view(view)});
  });
  return all;
}

void put_map(const Estimate& map, int first_row, ViewStack<float>& disparity,
             ViewStack<float>& confidence) {
  const ViewIndex view = map.field.disparity.first();
  if (!disparity.contains(view)) return;
  const auto put = [&](const ViewStack<float>& from, ViewStack<float>& to) {
    std::copy_n(from.view(view).row(first_row), to.view_size(), to.view(view).data);
  };
  put(map.field.disparity, disparity);
  put(map.confidence, confidence);
}

std::string carried_note(std::size_t views) {
  return fmt::format("carried to all views from {} of them", views);
}

}  // namespace episcope
