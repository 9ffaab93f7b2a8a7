// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/carried_run.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/memory.h"
#include "engine/core/parallel.h"
#include "engine/disparity/matching_cost.h"
#include "engine/disparity/view_samples.h"

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

// The corners of the grid but the first view: the views that see most of what it does not.
std::vector<ViewIndex> outermost_views(const CarriedMethod& method, GridShape grid) {
  std::vector<ViewIndex> views;
  if (!method.has_corners()) return views;
  const ViewIndex from = method.first_view();
  for (const int v : {0, grid.v - 1}) {
    for (const int u : {0, grid.u - 1}) {
      const ViewIndex view{v, u};
      if (view != from && std::ranges::find(views, view) == views.end()) views.push_back(view);
    }
  }
  return views;
}

ViewStack<float> rows_of_all(const MapGeometry& maps, int rows) {
  return {maps.grid, rows, maps.width, 1, maps.first};
}

void copy_rows(ImageView<const float> from, int from_row, int rows, float* to) {
  std::copy_n(from.row(from_row), static_cast<std::size_t>(rows) * from.width, to);
}

class CarriedBlocks {
 public:
  CarriedBlocks(const LightField& light_field, std::unique_ptr<CarriedMethod> method,
                ViewSelection selection, int threads)
      : lf_(light_field),
        method_(std::move(method)),
        from_(method_->first_view()),
        threads_(threads),
        range_(method_->range()) {
    views_ = {from_};
    maps_ = {{1, 1}, from_, lf_.height(), lf_.width()};
    if (selection == ViewSelection::Center || lf_.grid().count() == 1) return;
    maps_ = {lf_.grid(), {}, lf_.height(), lf_.width()};
    for (const ViewIndex view : outermost_views(*method_, lf_.grid())) views_.push_back(view);
  }

  [[nodiscard]] const MapGeometry& maps() const { return maps_; }
  [[nodiscard]] Interval range() const { return range_; }
  // Those that are estimated.
  [[nodiscard]] const std::vector<ViewIndex>& views() const { return views_; }

  [[nodiscard]] FinishedBlock estimate(ViewIndex view, const ReadBlock& read,
                                       const std::vector<double>& facts, const Progress& progress) {
    const MemorySetAside aside(static_cast<std::size_t>(bytes_of_view()));
    FinishedBlock made;
    if (view == from_) {
      known_.push_back(method_->estimate_first(progress));
      made.notes = known_.back().notes;
      made.facts = method_->facts();
    } else {
      restore(facts, progress.part(0, 0.02));
      const auto before = std::ranges::find(views_, view) - views_.begin();
      load(static_cast<std::size_t>(before), read);
      known_.push_back(method_->estimate_next(view, known_, progress.part(0.02, 1)));
    }
    is_restored_ = true;
    made.maps.field.disparity = known_.back().field.disparity.clone();
    made.maps.confidence = known_.back().confidence.clone();
    if (maps_.grid.count() == 1) made.maps.second = std::move(known_.back().second);
    return made;
  }

  [[nodiscard]] FinishedBlock carry(const MapBlock& block, const ReadBlock& read,
                                    const Progress& progress) {
    load(views_.size(), read);
    PropagatedMaps carried = propagate_to_views(known_, block.views, progress);
    for (const Estimate& map : known_) put_map(map, 0, carried.disparity, carried.confidence);
    return {{{std::move(carried.disparity), {}}, std::move(carried.confidence)}};
  }

  [[nodiscard]] FinishedBlock choose(const MapBlock& block, const ReadBlock& read,
                                     const std::vector<double>& facts, const Progress& progress) {
    load(views_.size(), read);
    restore(facts, progress.part(0, 0.02));
    begin_sides(progress.part(0.02, 0.05));
    const int first = std::max(block.first_row - reach_, 0);
    const int end = std::min(block.end_row + reach_, maps_.height);
    const LightField& compared = method_->compared();
    compared.fetch_samples(first, end);
    const ViewStack<float> before = rows_before(first, block.first_row, end, read, progress);
    const PackedViews packed = pack_rows(compared, first, end, progress.part(0.1, 0.2));
    FinishedBlock made{read(block)};
    choose_propagated_sides({packed, before, first, maps_.height}, cap_, block.first_row,
                            made.maps.field.disparity, progress.part(0.2, 1));
    for (const Estimate& map : known_) {
      put_map(map, block.first_row, made.maps.field.disparity, made.maps.confidence);
    }
    keep(before, first, std::max(block.end_row - reach_, first), block.end_row);
    return made;
  }

  // Beside large arrays.
  [[nodiscard]] double bytes_of_view() const {
    return method_->bytes_of_view() + pixels() * kOfMap * static_cast<double>(views_.size());
  }
  [[nodiscard]] double bytes_of_carried(int count) const {
    const auto known = static_cast<double>(views_.size());
    const double shown = kOfMap * known + sizeof(float);
    return pixels() * (kOfMap * (known + count) + shown * std::min(count, threads_));
  }
  [[nodiscard]] double bytes_of_bands(int rows) const {
    const double farthest = std::max(std::abs(range_.min), std::abs(range_.max)) + 0.5;
    const int reach = propagated_reach(maps_.grid, farthest);
    const double band = std::min(rows + 2 * reach, maps_.height);
    const double rays = static_cast<double>(maps_.grid.count()) * maps_.width;
    const double sample =
        static_cast<double>(lf_.byte_size()) / static_cast<double>(maps_.grid.count()) / pixels();
    const double looked_at = lf_.is_on_disk() ? sample : 0;
    constexpr double kBeforeAndRead = 12, kMade = 9, kKept = 4;
    return pixels() * (kOfMap + sizeof(float)) * static_cast<double>(views_.size()) +
           rays * ((kBeforeAndRead + looked_at) * band + kMade * rows + kKept * reach);
  }

 private:
  static constexpr double kOfMap = 8;

  [[nodiscard]] double pixels() const { return static_cast<double>(maps_.height) * maps_.width; }

  // The light field as it is compared.
  void restore(const std::vector<double>& facts, const Progress& progress) {
    if (!is_restored_) method_->restore(facts, progress);
    is_restored_ = true;
  }

  // The first maps, as far as this program has not made them.
  void load(std::size_t count, const ReadBlock& read) {
    while (known_.size() < count) {
      const ViewIndex view = views_[known_.size()];
      BlockMaps stored = read({{view, {1, 1}}, 0, maps_.height});
      Estimate map;
      map.range = range_;
      map.field = std::move(stored.field);
      map.confidence = std::move(stored.confidence);
      known_.push_back(std::move(map));
    }
  }

  [[nodiscard]] ViewStack<float> carried_disparity(ViewIndex view, const Progress& progress) const {
    return propagate_to_views(known_, {view, {1, 1}}, progress).disparity;
  }

  // What all bands have in common.
  void begin_sides(const Progress& progress) {
    if (reach_ > 0) return;
    double farthest = 0;
    for (const Estimate& map : known_) {
      const ViewStack<float>& disparity = map.field.disparity;
      for (std::size_t i = 0; i < disparity.size(); ++i) {
        farthest = std::max<double>(farthest, std::abs(disparity.data()[i]));
      }
      carried_.push_back(carried_disparity(disparity.first(), progress.part(0, 0)));
    }
    cap_ = propagated_cap(method_->compared(), from_, progress);
    reach_ = propagated_reach(maps_.grid, farthest);
  }

  // Carried maps of all views, rows [first, end), of which those before `replaced` may be lost.
  [[nodiscard]] ViewStack<float> rows_before(int first, int replaced, int end,
                                             const ReadBlock& read,
                                             const Progress& progress) const {
    const ViewStack<float> stored =
        read({{maps_.first, maps_.grid}, replaced, end}).field.disparity;
    const bool is_kept = !kept_.empty() && kept_first_ <= first && kept_end_ == replaced;
    ViewStack<float> before = rows_of_all(maps_, end - first);
    for (int i = 0; i < maps_.grid.count(); ++i) {
      const ViewIndex view = maps_.grid.view_at(i);
      const ImageView<float> out = before.view(view);
      copy_rows(stored.view(view), 0, end - replaced, out.row(replaced - first));
      if (first == replaced) continue;
      if (is_kept) {
        copy_rows(kept_.view(view), first - kept_first_, replaced - first, out.row(0));
      } else {
        const ViewStack<float> again = carried_disparity(view, progress.part(0.05, 0.05));
        copy_rows(again.view(view), first, replaced - first, out.row(0));
      }
    }
    // Views that were estimated are stored as they were, not as they are carried.
    for (const ViewStack<float>& carried : carried_) {
      copy_rows(carried.view(carried.first()), first, end - first,
                before.view(carried.first()).row(0));
    }
    return before;
  }

  // Rows that the next band looks at.
  void keep(const ViewStack<float>& before, int first, int keep_first, int keep_end) {
    kept_ = rows_of_all(maps_, keep_end - keep_first);
    kept_first_ = keep_first;
    kept_end_ = keep_end;
    for (int i = 0; i < maps_.grid.count(); ++i) {
      const ViewIndex view = maps_.grid.view_at(i);
      copy_rows(before.view(view), keep_first - first, keep_end - keep_first,
                kept_.view(view).row(0));
    }
  }

  const LightField& lf_;
  std::unique_ptr<CarriedMethod> method_;
  ViewIndex from_;
  int threads_;
  Interval range_;
  MapGeometry maps_;
  std::vector<ViewIndex> views_;
  bool is_restored_ = false;
  std::vector<Estimate> known_;  // Of the first of `views_`.
  // Of the choice of sides: what known maps are where they are carried to their own views, and rows
  // that were replaced.
  std::vector<ViewStack<float>> carried_;
  float cap_ = 0;
  int reach_ = 0;
  ViewStack<float> kept_;
  int kept_first_ = 0, kept_end_ = 0;
};

using SharedBlocks = std::shared_ptr<CarriedBlocks>;

BlockPass estimating(const SharedBlocks& blocks) {
  BlockPass pass;
  pass.step = "estimating views";
  pass.unit = BlockUnit::Views;
  pass.only = blocks->views();
  pass.bytes = [blocks](int) { return blocks->bytes_of_view(); };
  pass.compute = [blocks](const MapBlock& block, const ReadBlock& read,
                          const std::vector<double>& facts, const Progress& progress) {
    return blocks->estimate(block.views.first, read, facts, progress);
  };
  return pass;
}

BlockPass carrying(const SharedBlocks& blocks) {
  BlockPass pass;
  pass.step = "propagating to other views";
  pass.unit = BlockUnit::Views;
  pass.bytes = [blocks](int count) { return blocks->bytes_of_carried(count); };
  pass.compute = [blocks](const MapBlock& block, const ReadBlock& read, const std::vector<double>&,
                          const Progress& progress) {
    return blocks->carry(block, read, progress);
  };
  return pass;
}

BlockPass choosing(const SharedBlocks& blocks) {
  BlockPass pass;
  pass.step = "choosing sides";
  pass.bytes = [blocks](int rows) { return blocks->bytes_of_bands(rows); };
  pass.compute = [blocks](const MapBlock& block, const ReadBlock& read,
                          const std::vector<double>& facts, const Progress& progress) {
    return blocks->choose(block, read, facts, progress);
  };
  return pass;
}

// Changes nothing: the last pass marks invalid pixels, whose values the choice of sides needs until
// it has ended.
BlockPass marking(const MapGeometry& maps) {
  BlockPass pass;
  pass.step = "marking invalid pixels";
  pass.bytes = [maps](int rows) {
    constexpr double kMaps = 9;
    return kMaps * rows * maps.width * maps.grid.count();
  };
  pass.compute = [](const MapBlock& block, const ReadBlock& read, const std::vector<double>&,
                    const Progress&) { return FinishedBlock{read(block)}; };
  return pass;
}

// Maps of all views from those of some.
Estimate carried_to_all(const LightField& compared, const std::vector<Estimate>& maps,
                        const Progress& progress) {
  PropagatedMaps carried = propagate_to_views(maps, {{}, compared.grid()}, progress.part(0, 0.2));
  const Estimate& first = maps.front();
  Estimate estimate;
  estimate.set_provenance(first.provenance());
  estimate.field.disparity = std::move(carried.disparity);
  estimate.confidence = std::move(carried.confidence);
  const PackedViews packed = pack_views(compared, progress.part(0.2, 0.3));
  const float cap =
      propagated_cap(compared, first.field.disparity.first(), progress.part(0.3, 0.31));
  choose_propagated_sides(packed, cap, estimate, progress.part(0.31, 1));
  for (const Estimate& map : maps) put_map(map, 0, estimate.field.disparity, estimate.confidence);
  estimate.notes.push_back(propagated_note(maps.size()));
  return estimate;
}

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

Estimate run_carried(CarriedMethod& method, ViewSelection views, const Progress& progress) {
  const GridShape grid = method.compared().grid();
  if (views == ViewSelection::Center || grid.count() == 1) return method.estimate_first(progress);
  const std::vector<ViewIndex> corners = outermost_views(method, grid);
  const double next = method.share_of_next();
  const double share = 0.9 / (1 + next * static_cast<double>(corners.size()));
  std::vector<Estimate> maps;
  maps.push_back(method.estimate_first(progress.part(0, share)));
  for (std::size_t i = 0; i < corners.size() && !progress.finish_requested(); ++i) {
    const auto done = static_cast<double>(i);
    maps.push_back(method.estimate_next(
        corners[i], maps,
        progress.part(share * (1 + next * done), share * (1 + next * (done + 1)))));
  }
  return carried_to_all(method.compared(), maps, progress.part(0.9, 1));
}

BlockwiseRun carried_in_blocks(const LightField& lf, std::unique_ptr<CarriedMethod> method,
                               ViewSelection views, int threads) {
  const auto blocks = std::make_shared<CarriedBlocks>(lf, std::move(method), views, threads);
  BlockwiseRun run;
  run.maps = blocks->maps();
  run.provenance.range = blocks->range();
  run.passes.push_back(estimating(blocks));
  const std::size_t estimated = blocks->views().size();
  if (run.maps.grid.count() == 1) return run;
  run.passes.push_back(carrying(blocks));
  run.passes.push_back(choosing(blocks));
  if (!lf.valid().empty()) run.passes.push_back(marking(run.maps));
  run.notes = [estimated](const BlockProgress&) { return std::vector{propagated_note(estimated)}; };
  return run;
}

}  // namespace episcope
