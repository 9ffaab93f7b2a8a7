// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/propagate_planes.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/parallel.h"
#include "engine/disparity/matching_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

constexpr int kCarriedRadius = 2;
constexpr int kCarriedBandRows = 16;
constexpr float kLeastCarriedStep = 0.2F;  // px
constexpr float kHidingTolerance = 0.2F;
constexpr float kAdvantage = 0.95F;
// Between samples of one point without noise.
constexpr double kSmallDifference = 0.015;
// By so much differs the color of a neighbor that counts 1/e.
constexpr float kCarriedColorScale = 8.0F / 255;

using Color = std::array<float, 3>;

Color color_of(std::uint32_t packed) {
  return {packed_sample(packed, 0), packed_sample(packed, 1), packed_sample(packed, 2)};
}

float distance(const Color& a, const Color& b) {
  float sum = 0;
  for (int c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return std::sqrt(sum);
}

// Of a pixel beside a jump: its own disparity and that of the other side, and what they cost.
struct Sides {
  bool exist = false;
  std::array<float, 2> disparity{}, cost{};
};

// Decides bands of rows of one view; one per thread.
class Chooser {
 public:
  Chooser(const PropagatedRows& rows, float cap, ViewIndex view)
      : views_(rows.views),
        before_(rows.before),
        first_row_(rows.first_row),
        cap_(cap),
        view_(view),
        height_(rows.height),
        width_(rows.before.width()),
        sides_(static_cast<std::size_t>(kCarriedBandRows + 2 * kCarriedRadius) * width_) {}

  // Rows [begin, end), at most kCarriedBandRows; `disparity` begins with the first of them.
  void decide(int begin, int end, float* disparity) {
    begin_ = begin - kCarriedRadius;
    for (int y = std::max(begin_, 0); y < std::min(end + kCarriedRadius, height_); ++y) {
      for (int x = 0; x < width_; ++x) at(y, x) = find(y, x);
    }
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < width_; ++x) {
        const Sides& own = at(y, x);
        if (own.exist && other_wins(y, x)) {
          disparity[static_cast<std::size_t>(y - begin) * width_ + x] = own.disparity[1];
        }
      }
    }
  }

 private:
  Sides& at(int y, int x) { return sides_[static_cast<std::size_t>(y - begin_) * width_ + x]; }

  template <class Work>
  void around(int y, int x, const Work& work) const {
    for (int j = std::max(y - kCarriedRadius, 0); j <= std::min(y + kCarriedRadius, height_ - 1);
         ++j) {
      for (int i = std::max(x - kCarriedRadius, 0); i <= std::min(x + kCarriedRadius, width_ - 1);
           ++i) {
        work(j, i);
      }
    }
  }

  [[nodiscard]] Sides find(int y, int x) const {
    const ImageView<const float> map = before_.view(view_);
    const float own = map.at(y - first_row_, x);
    float low = own, high = own;
    around(y, x, [&](int j, int i) {
      low = std::min(low, map.at(j - first_row_, i));
      high = std::max(high, map.at(j - first_row_, i));
    });
    Sides sides;
    if (high - low <= kLeastCarriedStep) return sides;
    sides.exist = true;
    sides.disparity = {own, own - low < high - own ? high : low};
    const Color color = color_of(views_.pixels.view(view_).at(y - first_row_, x));
    for (int k = 0; k < 2; ++k) sides.cost[k] = cost(y, x, color, sides.disparity[k]);
    return sides;
  }

  [[nodiscard]] float cost(int y, int x, const Color& color, float disparity) const {
    const GridShape grid = before_.grid();
    float sum = 0;
    int count = 0;
    for (int n = 0; n < grid.count(); ++n) {
      const ViewIndex other = grid.view_at(n);
      if (other == view_) continue;
      const float row = static_cast<float>(y) - disparity * static_cast<float>(other.v - view_.v);
      const float column =
          static_cast<float>(x) - disparity * static_cast<float>(other.u - view_.u);
      const int top = static_cast<int>(std::floor(row)),
                left = static_cast<int>(std::floor(column));
      if (top < 0 || left < 0 || top + 1 >= height_ || left + 1 >= width_) continue;
      const float down = row - static_cast<float>(top), right = column - static_cast<float>(left);
      const int nearest_row = (down < 0.5F ? top : top + 1) - first_row_;
      const float there = before_.view(other).at(nearest_row, right < 0.5F ? left : left + 1);
      if (there > disparity + kHidingTolerance) continue;
      sum += std::min(cap_, distance(color, sample(other, {top, left}, down, right)));
      ++count;
    }
    return count > 0 ? sum / static_cast<float>(count) : cap_;
  }

  [[nodiscard]] Color sample(ViewIndex view, PixelIndex corner, float down, float right) const {
    const ImageView<const std::uint32_t> pixels = views_.pixels.view(view);
    const std::uint32_t* const above = pixels.row(corner.y - first_row_) + corner.x;
    const std::uint32_t* const below = pixels.row(corner.y + 1 - first_row_) + corner.x;
    const Color a = color_of(above[0]), b = color_of(above[1]);
    const Color c = color_of(below[0]), d = color_of(below[1]);
    Color all;
    for (int k = 0; k < 3; ++k) {
      const float upper = a[k] + right * (b[k] - a[k]), lower = c[k] + right * (d[k] - c[k]);
      all[k] = upper + down * (lower - upper);
    }
    return all;
  }

  // Which of the sides of a pixel those of its neighbors stand for is told by their disparity.
  bool other_wins(int y, int x) {
    const Sides& here = at(y, x);
    const bool is_near = here.disparity[0] > here.disparity[1];
    const ImageView<const std::uint32_t> pixels = views_.pixels.view(view_);
    const Color color = color_of(pixels.at(y - first_row_, x));
    float own = 0, other = 0;
    around(y, x, [&](int j, int i) {
      const Sides& there = at(j, i);
      if (!there.exist) return;
      const float off =
          distance(color, color_of(pixels.at(j - first_row_, i))) / kCarriedColorScale;
      const float weight = std::exp(-off * off);
      const int same = is_near == (there.disparity[0] > there.disparity[1]) ? 0 : 1;
      own += weight * there.cost[same];
      other += weight * there.cost[1 - same];
    });
    return other < kAdvantage * own;
  }

  const PackedViews& views_;
  const ViewStack<float>& before_;
  int first_row_;
  float cap_;
  ViewIndex view_;
  int height_, width_;
  int begin_ = 0;  // Row of the first of `sides_`.
  std::vector<Sides> sides_;
};

}  // namespace

PropagatedMaps propagate_to_views(const std::vector<Estimate>& maps, ViewRectangle views,
                                  const Progress& progress) {
  if (maps.empty()) throw InvalidInput("there is no map to carry to other views");
  const ViewStack<float>& map = maps.front().field.disparity;
  const auto stack = [&] {
    return ViewStack<float>(views.grid, map.height(), map.width(), 1, views.first);
  };
  PropagatedMaps all{stack(), stack()};
  progress.step("propagating to other views");
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

std::string propagated_note(std::size_t views) {
  return fmt::format(finding_text("run.propagated"), views);
}

void choose_propagated_sides(const PackedViews& views, float cap, Estimate& estimate,
                             const Progress& progress) {
  ViewStack<float>& disparity = estimate.field.disparity;
  const ViewStack<float> before = disparity.clone();
  choose_propagated_sides({views, before, 0, disparity.height()}, cap, 0, disparity, progress);
}

void choose_propagated_sides(const PropagatedRows& rows, float cap, int begin,
                             ViewStack<float>& disparity, const Progress& progress) {
  const GridShape grid = disparity.grid();
  const int end = begin + disparity.height();
  const int bands = (disparity.height() + kCarriedBandRows - 1) / kCarriedBandRows;
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    const double count = grid.count();
    parallel_for_workers(bands, progress.part(i / count, (i + 1) / count), [&] {
      return [&, chooser = Chooser(rows, cap, view)](int band) mutable {
        const int row = band * kCarriedBandRows;
        chooser.decide(begin + row, std::min(begin + row + kCarriedBandRows, end),
                       disparity.view(view).row(row));
      };
    });
  }
}

int propagated_reach(GridShape grid, double farthest) {
  const int steps = std::max(grid.v, grid.u) - 1;
  // Sides of neighbors, what they are found from, and the sample below a place.
  return 2 * kCarriedRadius + static_cast<int>(std::ceil(farthest * steps)) + 1;
}

float propagated_cap(const LightField& lf, ViewIndex view, const Progress& progress) {
  const double variance = view_noise_variance(lf, view, progress);
  return static_cast<float>(kSmallDifference + 2 * std::sqrt(3 * variance));
}

}  // namespace episcope
