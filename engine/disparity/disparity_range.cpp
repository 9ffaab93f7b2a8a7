// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/disparity_range.h"

#include "engine/core/finding.h"
#include "engine/core/image.h"
#include "engine/core/parallel.h"
#include "engine/disparity/block_disparities.h"
#include "engine/disparity/matching_cost.h"
#include "engine/disparity/structure_tensor.h"
#include "engine/disparity/view_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <numeric>

namespace episcope {
namespace {

// Coherence above which an orientation counts: the first that enough pixels reach. Noise lowers
// coherence long before it spoils orientations: at 10/255, those above 0.6 still end within 0.3 px
// of the true range. A higher start would exclude regions that are seen less well than others.
constexpr std::array<float, 3> kCoherent{0.8F, 0.7F, 0.6F};
// Share of the pixels that are enough.
constexpr double kEnoughOrientations = 0.2;
// Cells side by side that make an end of the range, and those of them that lie beyond it.
constexpr int kRun = 4;
constexpr int kLeftOut = 1;
// Horizontal EPIs looked at; blocks of vertical ones, and how many of them stand side by side.
constexpr int kLines = 96;
constexpr int kBlocks = 12;
constexpr int kRangeColumns = 16;

using Cells = std::vector<double>;

// Of the pixels looked at, those that reach each coherence but not the one before it.
struct Findings {
  std::array<Cells, kCoherent.size()> histograms;
  double pixels = 0;

  explicit Findings(double limit) {
    histograms.fill(
        Cells(static_cast<std::size_t>(2 * limit / OrientationHistogram::kCell) + 1, 0.0));
  }
  void add(const Findings& other) {
    pixels += other.pixels;
    for (std::size_t level = 0; level < histograms.size(); ++level) {
      add_cells(other.histograms[level], histograms[level]);
    }
  }
  static void add_cells(const Cells& from, Cells& to) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += from[i];
  }
};

void add_run(const float* disparity, const float* coherence, int count, double limit,
             Findings& findings) {
  findings.pixels += count;
  for (int i = 0; i < count; ++i) {
    const auto level = std::find_if(kCoherent.begin(), kCoherent.end(),
                                    [&](float least) { return coherence[i] >= least; });
    if (level == kCoherent.end()) continue;
    Cells& cells = findings.histograms[level - kCoherent.begin()];
    const int cell = static_cast<int>((disparity[i] + limit) / OrientationHistogram::kCell);
    cells[std::clamp<int>(cell, 0, static_cast<int>(cells.size()) - 1)] += 1;
  }
}

double total(const Cells& cells) {
  return std::accumulate(cells.begin(), cells.end(), 0.0);
}

// The disparities of the most coherent pixels, as many as are enough.
Cells most_coherent(const Findings& findings) {
  Cells sum = findings.histograms.front();
  for (std::size_t level = 1; level < findings.histograms.size(); ++level) {
    if (total(sum) >= kEnoughOrientations * findings.pixels) break;
    Findings::add_cells(findings.histograms[level], sum);
  }
  return sum;
}

// Tensors of one EPI alone: neighbors would cost as much again.
TensorScales coarse_scales() {
  TensorScales scales;
  scales.across = 0;
  return scales;
}

std::vector<Findings> collect(const LightField& lf, StructureTensor::Direction direction,
                              double limit, const Progress& progress) {
  const bool horizontal = direction == StructureTensor::Direction::Horizontal;
  const ViewIndex center = lf.center();
  const TensorSearch search = cover_range({-limit, limit}, 2);
  const TensorExtent largest = StructureTensor::largest_task(lf, direction, coarse_scales());
  const int extent = horizontal ? lf.height() : lf.width();
  const int thickness = horizontal ? 1 : std::min({kRangeColumns, largest.width, lf.width()});
  const int count = std::min((extent + thickness - 1) / thickness, horizontal ? kLines : kBlocks);
  // The first and the last lie at the borders: what lies there may be nearest or farthest of all.
  const auto place = [&](int i) { return count > 1 ? i * (extent - thickness) / (count - 1) : 0; };
  std::vector<Findings> findings(count, Findings(limit));
  parallel_for_workers(count, progress, [&] {
    return [&, tensor = StructureTensor(lf, direction, coarse_scales(), search)](int i) mutable {
      const auto add = [&](int, PixelIndex, int run, const float* disparity,
                           const float* coherence) {
        add_run(disparity, coherence, run, limit, findings[i]);
      };
      TensorTask task;
      task.camera_line = horizontal ? center.v : center.u;
      task.first_view = horizontal ? center.u : center.v;
      task.last_view = task.first_view + 1;
      if (horizontal) {
        task.begin = {place(i), 0};
        task.height = 1;
        task.width = lf.width();
        tensor.estimate(task, add);
        return;
      }
      task.width = thickness;
      for (int y = 0; y < lf.height(); y += largest.height) {
        task.begin = {y, place(i)};
        task.height = std::min(largest.height, lf.height() - y);
        tensor.estimate(task, add);
      }
    };
  });
  return findings;
}

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

constexpr int kRows = 64;
// Pixels matched together: 3×3.
constexpr int kSupportRadius = 1;
// Beyond it a view does not show the point.
constexpr double kSupportCap = 0.3;
// Labels nearer to the best one than that do not compete with it, px per view step.
constexpr float kApart = 0.75F;
// The best label costs at most this fraction of the next, and less by this, in samples of [0, 1].
constexpr float kRatio = 0.8F;
constexpr float kContrast = 0.004F;

// Costs of one row, `[label][x]`, averaged over the rows and columns around it.
class WindowCosts {
 public:
  WindowCosts(const LightField& lf, ViewIndex view, const std::vector<float>& labels,
              int radius = kSupportRadius)
      : matching_(lf, view, {MatchedViews::CrossHair, Interpolation::Bilinear, kSupportCap},
                  labels),
        radius_(radius),
        rows_(2 * radius + 1, static_cast<int>(labels.size()), lf.width()),
        sums_(lf.width()),
        means_(static_cast<int>(labels.size()), lf.width()),
        height_(lf.height()) {}

  const Image<float>& compute(int y, const Progress& progress) {
    const int count = std::min(2 * radius_ + 1, height_);
    const int first = std::clamp(y - radius_, 0, height_ - count);
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
      box_mean_row(sums_.data(), means_.width(), radius_, means_.row(l));
    }
    return means_;
  }

 private:
  MatchingCostRows matching_;
  int radius_;
  Volume<float> rows_;
  std::vector<float> sums_;
  Image<float> means_;
  int height_;
};

// The label that each pixel of a row distinctly matches; -1 if none.
std::vector<int> distinct_labels(const Image<float>& costs, const std::vector<float>& labels) {
  const int width = costs.width();
  std::vector<int> best(width);
  std::vector<float> least(costs.row(0), costs.row(0) + width);
  std::vector<float> next(width, std::numeric_limits<float>::infinity());
  for (int l = 1; l < costs.height(); ++l) {
    const float* const cost = costs.row(l);
    for (int x = 0; x < width; ++x) {
      if (cost[x] < least[x]) best[x] = l;
      least[x] = std::min(least[x], cost[x]);
    }
  }
  for (int l = 0; l < costs.height(); ++l) {
    const float* const cost = costs.row(l);
    for (int x = 0; x < width; ++x) {
      const bool competes = std::fabs(labels[l] - labels[best[x]]) >= kApart;
      next[x] = std::min(next[x], competes ? cost[x] : next[x]);
    }
  }
  for (int x = 0; x < width; ++x) {
    const bool is_distinct = least[x] <= kRatio * next[x] && next[x] - least[x] >= kContrast;
    if (!is_distinct) best[x] = -1;
  }
  return best;
}

// The range begins and ends where this share of the coherent pixels lies close together.
constexpr double kOrientationTail = 0.002;
// Coherent pixels below which orientations tell nothing.
constexpr double kFewPixels = 100;
// Blocks average over what they hold, and miss the ends by so much, px, and of their range, but
// hardly more than the last; so far beyond them do single pixels count that nothing confirms.
constexpr double kMissed = 0.05, kMissedShare = 0.08, kMissedMost = 0.35;
constexpr double kFarthest = 0.1, kFarthestShare = 0.125, kFarthestMost = 0.45;
// Labels at which pixels are matched, and how far they go beyond the orientations seen.
constexpr double kLabelStep = 0.25;
constexpr double kBeyond = 1.5;
// Orientations count where this share of the distinctly matching pixels does so within `kNear`, px
// of the views matched; what is taken off the ends that they give, and how much farther they lie
// than where nothing needs to confirm them, or are the same ends, less exact.
constexpr double kSupport = 0.002;
constexpr double kNear = 0.3;
constexpr double kInexact = 0.05;
constexpr double kWorth = 0.2;
// No range found reaches farther, px per view step.
constexpr double kMaxDisparity = 16;

// Leaves out orientations that hardly any pixel of smaller views confirms by matching: aliases of
// repeated patterns and of noise. None if nothing is left.
std::optional<Interval> confirmed_range(const LightField& lf, Interval searched,
                                        OrientationHistogram histogram, const Progress& progress) {
  const int factor = std::min(lf.height(), lf.width()) > 1 ? 2 : 1;
  const Interval range{searched.min / factor, searched.max / factor};
  const int count = static_cast<int>(std::ceil(range.length() / kLabelStep)) + 1;
  const std::vector<float> labels = equidistant_labels(range, count);
  const std::vector<double> support = label_support(
      smaller_views(lf, factor, progress.part(0, 0.3)), labels, progress.part(0.3, 1));
  for (int cell = 0; cell < histogram.size(); ++cell) {
    double sum = 0;
    for (int l = 0; l < count; ++l) {
      if (std::fabs(labels[l] - histogram.middle(cell) / factor) <= kNear) sum += support[l];
    }
    if (sum < kSupport) histogram.clear(cell);
  }
  const std::optional<Interval> ends = histogram.ends(kOrientationTail);
  if (!ends) return {};
  return grown(*ends, -kInexact);
}

Interval widened(Interval range, const std::optional<Interval>& confirmed) {
  if (confirmed && confirmed->min < range.min - kWorth) range.min = confirmed->min;
  if (confirmed && confirmed->max > range.max + kWorth) range.max = confirmed->max;
  return range;
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

}  // namespace

OrientationHistogram::OrientationHistogram(const LightField& lf, double limit,
                                           const Progress& progress)
    : limit_(limit) {
  Findings findings(limit);
  const auto add = [&findings](const std::vector<Findings>& parts) {
    for (const Findings& part : parts) findings.add(part);
  };
  if (lf.grid().u > 1) {
    add(collect(lf, StructureTensor::Direction::Horizontal, limit, progress.part(0, 0.5)));
  }
  if (lf.grid().v > 1) {
    add(collect(lf, StructureTensor::Direction::Vertical, limit, progress.part(0.5, 1)));
  }
  cells_ = most_coherent(findings);
  total_ = episcope::total(cells_);
}

std::optional<Interval> OrientationHistogram::ends(double tail) const {
  const double enough = tail * total_;
  const int size = static_cast<int>(cells_.size());
  const int before = cells_to_skip(cells_.begin(), cells_.end(), enough);
  if (before == size) return {};
  const int behind = cells_to_skip(cells_.rbegin(), cells_.rend(), enough);
  const double last = (size - behind - kLeftOut) * kCell - limit_;
  return Interval{(before + kLeftOut) * kCell - limit_, std::min(limit_, last)};
}

std::vector<double> label_support(const LightField& lf, const std::vector<float>& labels,
                                  const Progress& progress) {
  const int count = static_cast<int>(labels.size());
  const int rows = std::min(kRows, lf.height());
  std::vector<double> counts(static_cast<std::size_t>(rows) * count);
  parallel_for_workers(rows, progress, [&] {
    return [&, costs = WindowCosts(lf, lf.center(), labels)](int i) mutable {
      const int y = rows > 1 ? i * (lf.height() - 1) / (rows - 1) : 0;
      double* const of_row = counts.data() + static_cast<std::size_t>(i) * count;
      const std::vector<int> matched = distinct_labels(costs.compute(y, progress), labels);
      for (int x = 0; x < lf.width(); ++x) {
        if (matched[x] >= 0 && lf.is_valid(lf.center(), y, x)) of_row[matched[x]] += 1;
      }
    };
  });
  std::vector<double> shares(count);
  for (std::size_t i = 0; i < counts.size(); ++i) shares[i % count] += counts[i];
  const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= std::max(total, 1.0);
  return shares;
}

std::optional<double> matched_disparity(const LightField& lf, ViewIndex view, PixelIndex pixel,
                                        Interval range, const Progress& progress) {
  constexpr double step = 0.1;
  constexpr int radius = 3;
  const int count = static_cast<int>(std::ceil(range.length() / step)) + 1;
  const std::vector<float> labels = equidistant_labels(range, count);
  WindowCosts windows(lf, view, labels, radius);
  const int matched = distinct_labels(windows.compute(pixel.y, progress), labels)[pixel.x];
  return matched < 0 ? std::nullopt : std::optional<double>(labels[matched]);
}

// The largest disparity whose neighboring views still share most of the image.
double farthest_found(const LightField& lf) {
  const int along = std::min(lf.grid().u > 1 ? lf.width() : lf.height(),
                             lf.grid().v > 1 ? lf.height() : lf.width());
  return std::clamp(along / 6.0, 2.0, kMaxDisparity);
}

std::string limited_range_note(const LightField& lf, Interval range) {
  constexpr double near = 0.25;  // the width in which pixels are counted, and a little
  const double limit = farthest_found(lf);
  if (range == kNothingSeen) {
    return fmt::format(finding_text("range.nothing"), range.min, range.max);
  }
  if (range.min > near - limit && range.max < limit - near) return {};
  return fmt::format(finding_text("range.limited"), range.min, range.max, limit);
}

Interval find_disparity_range(const LightField& lf, const Progress& progress) {
  const double limit = farthest_found(lf);
  const OrientationHistogram histogram(lf, limit, progress.part(0, 0.6));
  std::optional<Interval> seen;
  if (histogram.total() >= kFewPixels) seen = histogram.ends(kOrientationTail);
  const std::optional<Interval> certain = certain_range(lf, limit, seen, progress.part(0.6, 0.9));
  if (!certain) return seen.value_or(kNothingSeen);
  const double length = certain->length();
  const Interval all{-limit, limit};
  const Interval least =
      clipped(grown(*certain, std::min(kMissed + kMissedShare * length, kMissedMost)), all);
  if (!seen) return least;
  Interval most = grown(*certain, std::min(kFarthest + kFarthestShare * length, kFarthestMost));
  if (seen->min < most.min || seen->max > most.max) {
    const Interval searched = united(*certain, grown(*seen, kBeyond));
    most = widened(most, confirmed_range(lf, searched, histogram, progress.part(0.9, 1)));
  }
  return clipped(united(least, *seen), clipped(most, all));
}

std::string foreign_range_note(const LightField& lf, Interval given) {
  const Interval seen = search_range(lf, IntervalOrAuto::found(), Progress());
  const bool meets = given.min < seen.max && seen.min < given.max;
  if (meets || seen == kNothingSeen) return {};
  return fmt::format(finding_text("range.elsewhere"), given.min, given.max, seen.min, seen.max);
}

RangeSource range_source(const LightField& lf, const IntervalOrAuto& wanted) {
  if (wanted) return RangeSource::Given;
  const bool is_promised = !wanted.is_found && lf.info().disparity_range;
  return is_promised ? RangeSource::Promised : RangeSource::Found;
}

std::string found_range_note(Interval range) {
  return fmt::format(finding_text("range.found"), range.min, range.max);
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
