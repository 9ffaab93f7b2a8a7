// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/carried_sides.h"

#include "engine/core/parallel/parallel.h"
#include "engine/disparity/common/local_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace episcope {
namespace {

constexpr int kRadius = 2;
constexpr int kBandRows = 16;
constexpr float kLeastStep = 0.2F;  // px
constexpr float kTolerance = 0.2F;
constexpr float kAdvantage = 0.95F;
// Between samples of one point without noise.
constexpr double kSmallDifference = 0.015;
// By so much differs the colour of a neighbour that counts 1/e.
constexpr float kColorScale = 8.0F / 255;

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
  Chooser(const CarriedRows& rows, float cap, ViewIndex view)
      : views_(rows.views),
        before_(rows.before),
        first_row_(rows.first_row),
        cap_(cap),
        view_(view),
        height_(rows.height),
        width_(rows.before.width()),
        sides_(static_cast<std::size_t>(kBandRows + 2 * kRadius) * width_) {}

  // Rows [begin, end), at most kBandRows; `disparity` begins with the first of them.
  void decide(int begin, int end, float* disparity) {
    begin_ = begin - kRadius;
    for (int y = std::max(begin_, 0); y < std::min(end + kRadius, height_); ++y) {
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
    for (int j = std::max(y - kRadius, 0); j <= std::min(y + kRadius, height_ - 1); ++j) {
      for (int i = std::max(x - kRadius, 0); i <= std::min(x + kRadius, width_ - 1); ++i) {
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
    if (high - low <= kLeastStep) return sides;
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
      if (there > disparity + kTolerance) continue;
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

  // Which of the sides of a pixel those of its neighbours stand for is told by their disparity.
  bool other_wins(int y, int x) {
    const Sides& here = at(y, x);
    const bool is_near = here.disparity[0] > here.disparity[1];
    const ImageView<const std::uint32_t> pixels = views_.pixels.view(view_);
    const Color color = color_of(pixels.at(y - first_row_, x));
    float own = 0, other = 0;
    around(y, x, [&](int j, int i) {
      const Sides& there = at(j, i);
      if (!there.exist) return;
      const float off = distance(color, color_of(pixels.at(j - first_row_, i))) / kColorScale;
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

void choose_carried_sides(const PackedViews& views, float cap, Estimate& estimate,
                          const Progress& progress) {
  ViewStack<float>& disparity = estimate.field.disparity;
  const ViewStack<float> before = disparity.clone();
  choose_carried_sides({views, before, 0, disparity.height()}, cap, 0, disparity, progress);
}

void choose_carried_sides(const CarriedRows& rows, float cap, int begin,
                          ViewStack<float>& disparity, const Progress& progress) {
  const GridShape grid = disparity.grid();
  const int end = begin + disparity.height();
  const int bands = (disparity.height() + kBandRows - 1) / kBandRows;
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i);
    const double count = grid.count();
    parallel_for_workers(bands, progress.part(i / count, (i + 1) / count), [&] {
      return [&, chooser = Chooser(rows, cap, view)](int band) mutable {
        const int row = band * kBandRows;
        chooser.decide(begin + row, std::min(begin + row + kBandRows, end),
                       disparity.view(view).row(row));
      };
    });
  }
}

int carried_reach(GridShape grid, double farthest) {
  const int steps = std::max(grid.v, grid.u) - 1;
  // Sides of neighbours, what they are found from, and the sample below a place.
  return 2 * kRadius + static_cast<int>(std::ceil(farthest * steps)) + 1;
}

float carried_cap(const LightField& lf, ViewIndex view, const Progress& progress) {
  const double variance = view_noise_variance(lf, view, progress);
  return static_cast<float>(kSmallDifference + 2 * std::sqrt(3 * variance));
}

}  // namespace episcope
