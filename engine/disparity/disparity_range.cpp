// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/disparity_range.h"

#include "engine/core/image.h"
#include "engine/core/parallel.h"
#include "engine/core/volume.h"
#include "engine/disparity/matching_cost.h"
#include "engine/disparity/structure_tensor.h"
#include "engine/disparity/view_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace episcope {
namespace {

// Coherence above which an orientation counts. Noise lowers coherence long before it spoils
// orientations, and what is spoiled is not confirmed.
constexpr float kCoherent = 0.5F;
// Cells side by side that make an end of the range, and those of them left out at either end.
constexpr int kRun = 4;
constexpr int kLeftOut = 1;
// Rows of the center view looked at; blocks of columns of EPIs that cross them, and how many of
// these stand side by side.
constexpr int kRows = 64;
constexpr int kBlocks = 12;
constexpr int kSupportColumns = 16;

// How many cells lie before the first run of kRun that holds enough; all if none does.
template <class Iterator>
int cells_to_skip(Iterator begin, Iterator end, double enough) {
  double sum = 0;
  for (Iterator cell = begin; cell != end; ++cell) {
    sum += *cell;
    if (cell - begin >= kRun) sum -= *(cell - kRun);
    if (sum >= enough) return std::max(0, static_cast<int>(cell - begin) + 1 - kRun);
  }
  return static_cast<int>(end - begin);
}

}  // namespace

DisparityHistogram::DisparityHistogram(double limit)
    : limit_(limit), cells_(static_cast<std::size_t>(2 * limit / kCell) + 1) {}

void DisparityHistogram::add(double disparity) {
  const int cell = static_cast<int>((disparity + limit_) / kCell);
  cells_[std::clamp<int>(cell, 0, static_cast<int>(cells_.size()) - 1)] += 1;
  total_ += 1;
}

std::optional<Interval> DisparityHistogram::ends(double tail) const {
  const double enough = std::max(tail * total_, 1.0);
  const int size = static_cast<int>(cells_.size());
  const int before = cells_to_skip(cells_.begin(), cells_.end(), enough);
  if (before == size) return {};
  const int behind = cells_to_skip(cells_.rbegin(), cells_.rend(), enough);
  const double first = (before + kLeftOut) * kCell - limit_;
  const double last = (size - behind - kLeftOut) * kCell - limit_;
  return Interval{first, std::min(limit_, last)};
}

namespace {

// Tensors of one EPI alone: neighbors would cost as much again.
TensorScales coarse_scales() {
  TensorScales scales;
  scales.across = 0;
  return scales;
}

// Rows from the first to the last: what lies at the borders may be nearest or farthest of all.
std::vector<int> rows_looked_at(int height) {
  std::vector<int> rows(std::min(kRows, height));
  const int last = static_cast<int>(rows.size()) - 1;
  for (int i = 0; i <= last; ++i) rows[i] = last > 0 ? i * (height - 1) / last : 0;
  return rows;
}

// What the EPIs of one direction show of some rows of the center view, `[row][x]`; coherence 0
// where none is looked at.
struct Orientations {
  Image<float> disparity;
  Image<float> coherence;

  Orientations(int rows, int width) : disparity(rows, width), coherence(rows, width) {}
  void set(int row, int x, int count, const float* from_disparity, const float* from_coherence) {
    std::copy_n(from_disparity, count, disparity.row(row) + x);
    std::copy_n(from_coherence, count, coherence.row(row) + x);
  }
};

Orientations look_along_rows(const LightField& lf, const std::vector<int>& rows, double limit,
                             const Progress& progress) {
  const int count = static_cast<int>(rows.size());
  const TensorSearch search = cover_range({-limit, limit}, 2);
  Orientations seen(count, lf.width());
  parallel_for_workers(count, progress, [&] {
    return [&, tensor = StructureTensor(lf, StructureTensor::Direction::Horizontal, coarse_scales(),
                                        search)](int i) mutable {
      const ViewIndex center = lf.center();
      tensor.estimate(
          {center.v, {rows[i], 0}, 1, lf.width(), center.u, center.u + 1},
          [&](int, PixelIndex begin, int run, const float* disparity, const float* coherence) {
            seen.set(i, begin.x, run, disparity, coherence);
          });
    };
  });
  return seen;
}

Orientations look_along_columns(const LightField& lf, const std::vector<int>& rows, double limit,
                                const Progress& progress) {
  constexpr auto direction = StructureTensor::Direction::Vertical;
  const TensorSearch search = cover_range({-limit, limit}, 2);
  const TensorExtent largest = StructureTensor::largest_task(lf, direction, coarse_scales());
  const int columns = std::min({kSupportColumns, largest.width, lf.width()});
  const int blocks = std::min((lf.width() + columns - 1) / columns, kBlocks);
  std::vector<int> row_at(lf.height(), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) row_at[rows[i]] = static_cast<int>(i);
  Orientations seen(static_cast<int>(rows.size()), lf.width());
  parallel_for_workers(blocks, progress, [&] {
    return [&, tensor = StructureTensor(lf, direction, coarse_scales(), search)](int i) mutable {
      const ViewIndex center = lf.center();
      TensorTask task{center.u, {0, 0}, 0, columns, center.v, center.v + 1};
      if (blocks > 1) task.begin.x = i * (lf.width() - columns) / (blocks - 1);
      for (int& y = task.begin.y; y < lf.height(); y += largest.height) {
        task.height = std::min(largest.height, lf.height() - y);
        tensor.estimate(task, [&](int, PixelIndex begin, int run, const float* disparity,
                                  const float* coherence) {
          const int row = row_at[begin.y];
          if (row >= 0) seen.set(row, begin.x, run, disparity, coherence);
        });
      }
    };
  });
  return seen;
}

// Calls `take(row, x, disparity)` for every pixel and direction that is coherent.
template <class Take>
void for_each_coherent(const std::vector<Orientations>& directions, const Take& take) {
  for (const Orientations& seen : directions) {
    for (int row = 0; row < seen.coherence.height(); ++row) {
      for (int x = 0; x < seen.coherence.width(); ++x) {
        if (seen.coherence.at(row, x) >= kCoherent) take(row, x, seen.disparity.at(row, x));
      }
    }
  }
}

}  // namespace

namespace {

// Means of blocks of one view.
void reduce(const LightField& lf, ViewIndex view, int factor, ImageView<std::uint16_t> out) {
  const int channels = lf.channels(), width = out.width * factor;
  const float scale = 65535.0F / static_cast<float>(factor * factor);
  std::vector<float> row(static_cast<std::size_t>(width) * channels);
  std::vector<float> sums(static_cast<std::size_t>(out.width) * channels);
  for (int y = 0; y < out.height; ++y) {
    std::ranges::fill(sums, 0.0F);
    for (int dy = 0; dy < factor; ++dy) {
      lf.read_row(view, y * factor + dy, 0, width, row.data());
      for (int x = 0; x < width; ++x) {
        float* const sum = sums.data() + static_cast<std::size_t>(x / factor) * channels;
        for (int c = 0; c < channels; ++c)
          sum[c] += row[static_cast<std::size_t>(x) * channels + c];
      }
    }
    std::uint16_t* const to = out.row(y);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const float clamped = std::clamp(sums[i] * scale, 0.0F, 65535.0F);
      to[i] = static_cast<std::uint16_t>(clamped + 0.5F);
    }
  }
}

void reduce_valid(const LightField& lf, ViewIndex view, int factor, ImageView<std::uint8_t> out) {
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      bool is_valid = true;
      for (int i = 0; i < factor * factor; ++i) {
        is_valid = is_valid && lf.is_valid(view, y * factor + i / factor, x * factor + i % factor);
      }
      out.at(y, x) = is_valid ? 1 : 0;
    }
  }
}

}  // namespace

LightField smaller_views(const LightField& lf, int factor, const Progress& progress,
                         ReducedViews reduced) {
  const GridShape grid = lf.grid();
  const int height = lf.height() / factor, width = lf.width() / factor;
  ViewStack<std::uint16_t> samples(grid, height, width, lf.channels(), {}, allocate_large_zeros);
  ViewStack<std::uint8_t> valid;
  if (!lf.valid().empty()) valid = ViewStack<std::uint8_t>(grid, height, width);
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = samples.view_at(i), center = lf.center();
    if (reduced == ReducedViews::All || view.v == center.v || view.u == center.u) {
      reduce(lf, view, factor, samples.view(view));
    }
    if (!valid.empty()) reduce_valid(lf, view, factor, valid.view(view));
    lf.forget_samples();
  });
  return {std::move(samples), LightFieldInfo(), std::move(valid)};
}

namespace {

// Labels at which pixels are matched, px per view step.
constexpr double kLabelStep = 0.25;
// Pixels matched together: 3×3.
constexpr int kSupportRadius = 1;
// Beyond it a view does not show the point.
constexpr double kSupportCap = 0.3;
// Labels nearer to the best one than that do not compete with it, px per view step.
constexpr float kApart = 0.75F;
// The best label costs at most this fraction of the next, and less by this, in samples of [0, 1].
constexpr float kRatio = 0.8F;
constexpr float kContrast = 0.002F;

// Costs of one row, `[label][x]`, averaged over the rows and columns around it.
class WindowCosts {
 public:
  WindowCosts(const LightField& lf, const std::vector<float>& labels)
      : matching_(lf, lf.center(), {MatchedViews::CrossHair, Interpolation::Bilinear, kSupportCap},
                  labels),
        rows_(2 * kSupportRadius + 1, static_cast<int>(labels.size()), lf.width()),
        sums_(lf.width()),
        means_(static_cast<int>(labels.size()), lf.width()),
        height_(lf.height()) {}

  const Image<float>& compute(int y, const Progress& progress) {
    const int count = std::min(2 * kSupportRadius + 1, height_);
    const int first = std::clamp(y - kSupportRadius, 0, height_ - count);
    VolumeView<float> costs = rows_.view();
    costs.height = count;
    matching_.compute(first, costs, progress);
    for (int l = 0; l < means_.height(); ++l) {
      std::ranges::fill(sums_, 0.0F);
      for (int row = 0; row < count; ++row) {
        const float* const cost = &costs.at(row, l, 0);
        for (std::size_t x = 0; x < sums_.size(); ++x) {
          sums_[x] += cost[x] / static_cast<float>(count);
        }
      }
      box_mean_row(sums_.data(), means_.width(), kSupportRadius, means_.row(l));
    }
    return means_;
  }

 private:
  MatchingCostRows matching_;
  Volume<float> rows_;
  std::vector<float> sums_;
  Image<float> means_;
  int height_;
};

// Into `matches` the disparity that each pixel of a row distinctly matches: its best label, moved
// by the parabola through the costs beside it.
void find_distinct(const Image<float>& costs, const std::vector<float>& labels,
                   const LightField& lf, int y, float* matches) {
  const int width = costs.width(), last = costs.height() - 1;
  std::vector<int> best(width);
  std::vector<float> least(costs.row(0), costs.row(0) + width);
  std::vector<float> next(width, std::numeric_limits<float>::infinity());
  for (int l = 1; l <= last; ++l) {
    const float* const cost = costs.row(l);
    for (int x = 0; x < width; ++x) {
      if (cost[x] < least[x]) best[x] = l;
      least[x] = std::min(least[x], cost[x]);
    }
  }
  for (int l = 0; l <= last; ++l) {
    const float* const cost = costs.row(l);
    for (int x = 0; x < width; ++x) {
      const bool competes = std::fabs(labels[l] - labels[best[x]]) >= kApart;
      next[x] = std::min(next[x], competes ? cost[x] : next[x]);
    }
  }
  for (int x = 0; x < width; ++x) {
    const bool is_distinct = least[x] <= kRatio * next[x] && next[x] - least[x] >= kContrast;
    matches[x] = std::numeric_limits<float>::quiet_NaN();
    if (!is_distinct || best[x] == 0 || best[x] == last) continue;
    if (!lf.is_valid(lf.center(), y, x)) continue;
    const float before = costs.at(best[x] - 1, x), after = costs.at(best[x] + 1, x);
    const float bend = before - 2 * least[x] + after;
    const float offset = bend > 0 ? 0.5F * (before - after) / bend : 0;
    matches[x] = labels[best[x]] + offset * (labels[1] - labels[0]);
  }
}

}  // namespace

Image<float> distinct_matches(const LightField& lf, const std::vector<int>& rows, Interval range,
                              const Progress& progress) {
  const int steps = static_cast<int>(std::ceil(range.length() / kLabelStep));
  const std::vector<float> labels = equidistant_labels(range, std::max(steps, 2) + 1);
  const int count = static_cast<int>(rows.size());
  Image<float> matches(count, lf.width());
  parallel_for_workers(count, progress, [&] {
    return [&, costs = WindowCosts(lf, labels)](int i) mutable {
      find_distinct(costs.compute(rows[i], progress), labels, lf, rows[i], matches.row(i));
    };
  });
  return matches;
}

namespace {

// The range begins and ends where this share of the confirmed pixels lies close together.
constexpr double kTail = 0.002;
// The same of smaller views, whose noise is smaller and whose ends are less exact.
constexpr double kSmallTail = 0.006;
// How far beyond the orientations seen pixels are matched.
constexpr double kBeyond = 1.5;
// An orientation is confirmed where its pixel distinctly matches a disparity within this, px.
constexpr float kNear = 0.2F;
// Pixels below which nothing is said.
constexpr double kLeastPixels = 50;
// What is taken off the ends that smaller views give, pixels of theirs.
constexpr double kInexact = 0.075;
// No range found reaches farther, px per view step.
constexpr double kMaxDisparity = 16;

// The disparities of pixels that match distinctly where an orientation of theirs is: not aliases of
// repeated patterns and of noise. None if no pixel matches distinctly: all is one repeated pattern,
// of which nothing tells which orientation is true.
std::optional<DisparityHistogram> confirmed(const LightField& lf, const std::vector<int>& rows,
                                            const std::vector<Orientations>& directions,
                                            double limit, Interval seen, const Progress& progress) {
  const Interval range{seen.min - kBeyond, seen.max + kBeyond};
  const Image<float> matches = distinct_matches(lf, rows, range, progress);
  if (std::ranges::all_of(matches, [](float match) { return std::isnan(match); })) return {};
  DisparityHistogram histogram(limit);
  for_each_coherent(directions, [&](int row, int x, float disparity) {
    const float match = matches.at(row, x);
    if (std::fabs(disparity - match) <= kNear) histogram.add(match);
  });
  return histogram;
}

// None if hardly anything is seen or confirmed.
std::optional<Interval> confirmed_range(const LightField& lf, double limit, double tail,
                                        const Progress& progress) {
  const std::vector<int> rows = rows_looked_at(lf.height());
  std::vector<Orientations> directions;
  if (lf.grid().u > 1) {
    directions.push_back(look_along_rows(lf, rows, limit, progress.part(0, 0.4)));
  }
  if (lf.grid().v > 1) {
    directions.push_back(look_along_columns(lf, rows, limit, progress.part(0.4, 0.8)));
  }
  DisparityHistogram all(limit);
  for_each_coherent(directions, [&](int, int, float d) { all.add(d); });
  const std::optional<Interval> seen = all.ends(tail);
  if (!seen || all.total() < kLeastPixels) return {};
  const std::optional<DisparityHistogram> kept =
      confirmed(lf, rows, directions, limit, *seen, progress.part(0.8, 1));
  if (!kept) return seen;
  if (kept->total() < kLeastPixels) return {};
  return kept->ends(tail);
}

// Smaller views show what noise and blur hide, but their ends are less exact.
std::optional<Interval> range_of_smaller_views(const LightField& lf, int factor, double limit,
                                               const Progress& progress) {
  constexpr int least = 48;
  if (std::min(lf.height(), lf.width()) < least * factor) return {};
  const LightField smaller = smaller_views(lf, factor, progress.part(0, 0.2));
  const std::optional<Interval> found =
      confirmed_range(smaller, limit / factor, kSmallTail, progress.part(0.2, 1));
  if (!found) return {};
  const double inset = kInexact * factor;
  return Interval{factor * found->min + inset, factor * found->max - inset};
}

// The range found last, for runs that follow on the same light field: nothing else decides it.
class KeptRange {
 public:
  template <class Find>
  Interval of(const LightField& lf, const Find& find) {
    {
      const std::lock_guard lock(mutex_);
      if (identity_ == lf.identity()) return range_;
    }
    const Interval found = find();
    const std::lock_guard lock(mutex_);
    identity_ = lf.identity();
    return range_ = found;
  }

 private:
  std::mutex mutex_;
  std::uint64_t identity_ = 0;
  Interval range_;
};

// An end that is hardly farther out is the same end, less exact.
Interval widened(Interval range, Interval coarse) {
  constexpr double worth = 0.25;
  if (coarse.min < range.min - worth) range.min = coarse.min;
  if (coarse.max > range.max + worth) range.max = coarse.max;
  return range;
}

}  // namespace

// The largest disparity whose neighboring views still share most of the image.
double farthest_found(const LightField& lf) {
  const int along = std::min(lf.grid().u > 1 ? lf.width() : lf.height(),
                             lf.grid().v > 1 ? lf.height() : lf.width());
  return std::clamp(along / 6.0, 2.0, kMaxDisparity);
}

std::string limited_range_note(const LightField& lf, Interval range) {
  constexpr double near = 0.25;  // the width in which pixels are counted, and a little
  const double limit = farthest_found(lf);
  if (range.min > near - limit && range.max < limit - near) return {};
  return fmt::format(
      "the disparity range found, {:.2f} … {:.2f} px, ends where the search does, at ±{:.2f} px: "
      "the scene may reach farther; give a range to search it",
      range.min, range.max, limit);
}

Interval find_disparity_range(const LightField& lf, const Progress& progress) {
  const double limit = farthest_found(lf);
  std::optional<Interval> found = confirmed_range(lf, limit, kTail, progress.part(0, 0.6));
  for (const int factor : {2, 4}) {
    const Progress part = factor == 2 ? progress.part(0.6, 0.85) : progress.part(0.85, 1);
    const std::optional<Interval> coarse = range_of_smaller_views(lf, factor, limit, part);
    if (!coarse) continue;
    found = found ? widened(*found, *coarse) : *coarse;
  }
  return found.value_or(Interval{-1, 1});
}

RangeSource range_source(const LightField& lf, const IntervalOrAuto& wanted) {
  if (wanted) return RangeSource::Given;
  const bool is_promised = !wanted.is_found && lf.info().disparity_range;
  return is_promised ? RangeSource::Promised : RangeSource::Found;
}

std::string found_range_note(Interval range) {
  return fmt::format("disparity range {:.2f} … {:.2f} px, found from the images", range.min,
                     range.max);
}

Interval search_range(const LightField& lf, const IntervalOrAuto& wanted,
                      const Progress& progress) {
  const RangeSource source = range_source(lf, wanted);
  if (source == RangeSource::Given) return *wanted;
  if (source == RangeSource::Promised) return *lf.info().disparity_range;
  static KeptRange kept;
  return kept.of(lf, [&] {
    progress.step("disparity range");
    return find_disparity_range(lf, progress);
  });
}

}  // namespace episcope
