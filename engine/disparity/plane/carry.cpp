// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/carry.h"

#include "engine/core/error.h"
#include "engine/core/parallel/parallel.h"
#include "engine/disparity/common/surfaces_in_views.h"

#include <algorithm>
#include <limits>

namespace episcope {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

// A view while it is filled; kNothingNear where nothing is known.
struct Target {
  ImageView<float> disparity, confidence;
};

void take(ImageView<const float> from, ImageView<float> to) {
  for (int y = 0; y < to.height; ++y) std::copy_n(from.row(y), to.width, to.row(y));
}

void cast(const Estimate& map, ViewIndex to, const Target& out) {
  const ViewIndex from = map.field.disparity.first();
  const ImageView<const float> disparity = map.field.disparity.view(from);
  const ImageView<const float> confidence = map.confidence.view(from);
  if (from == to) {
    take(disparity, out.disparity);
    return take(confidence, out.confidence);
  }
  std::fill_n(out.disparity.data, out.disparity.size(), kNothingNear);
  const ViewIndex step{to.v - from.v, to.u - from.u};
  for (int y = 0; y < disparity.height; ++y) {
    for (int x = 0; x < disparity.width; ++x) {
      const float d = disparity.at(y, x);
      const CoveredPixels covered = covered_pixels(d, {y, x}, step, disparity.height, disparity.width);
      for (int row = covered.first.y; row <= covered.last.y; ++row) {
        for (int column = covered.first.x; column <= covered.last.x; ++column) {
          if (out.disparity.at(row, column) >= d) continue;
          out.disparity.at(row, column) = d;
          out.confidence.at(row, column) = confidence.at(y, x);
        }
      }
    }
  }
}

// What `other` shows where nothing is known, if it is farther than what was found there before.
void complete(const Target& other, ImageView<const float> first, const Target& out) {
  for (int y = 0; y < first.height; ++y) {
    for (int x = 0; x < first.width; ++x) {
      const float d = other.disparity.at(y, x);
      if (first.at(y, x) > kNothingNear || d <= kNothingNear) continue;
      float& found = out.disparity.at(y, x);
      if (found > kNothingNear && found <= d) continue;
      found = d;
      out.confidence.at(y, x) = other.confidence.at(y, x);
    }
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

}  // namespace

CarriedMaps carry_to_views(const std::vector<Estimate>& maps, GridShape grid,
                           const Progress& progress) {
  if (maps.empty()) throw InvalidInput("there is no map to carry to other views");
  const int height = maps.front().field.disparity.height();
  const int width = maps.front().field.disparity.width();
  CarriedMaps all{ViewStack<float>(grid, height, width), ViewStack<float>(grid, height, width)};
  progress.step("carrying to other views");
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = grid.view_at(i);
    const Target out{all.disparity.view(view), all.confidence.view(view)};
    cast(maps.front(), view, out);
    Image<float> first(height, width), disparity(height, width), confidence(height, width);
    take(out.disparity, first.view());
    for (std::size_t k = 1; k < maps.size(); ++k) {
      const Target other{disparity.view(), confidence.view()};
      cast(maps[k], view, other);
      complete(other, first, out);
    }
    fill(out);
  });
  return all;
}

}  // namespace episcope
