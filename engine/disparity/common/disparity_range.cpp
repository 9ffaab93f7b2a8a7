// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/disparity_range.h"

#include "engine/core/parallel/parallel.h"
#include "engine/disparity/common/label_support.h"
#include "engine/disparity/common/matching_cost.h"
#include "engine/disparity/tensor/structure_tensor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace episcope {
namespace {

// Width of a histogram cell, px per view step.
constexpr double kCell = 0.05;
// Coherence above which an orientation counts: the first that enough pixels reach. Noise lowers
// coherence long before it spoils orientations: at 10/255, those above 0.6 still end within 0.3 px
// of the true range. A higher start would exclude regions that are seen less well than others.
constexpr std::array<float, 3> kCoherent{0.8F, 0.7F, 0.6F};
// Share of the pixels that are enough.
constexpr double kEnough = 0.2;
// The range begins and ends with the first run of so many cells that holds this share of the
// coherent pixels. Orientations that noise alone gives are spread thinly over all disparities; what
// is seen lies close together, and counts even where few of its pixels are coherent. Half of the
// run is the margin.
constexpr int kRun = 4;
constexpr double kTail = 0.002;
// Labels at which pixels are matched, and the share of them that must match best at one of three
// labels side by side if orientations are to count there and a few labels on.
constexpr double kLabelStep = 0.5;
constexpr double kSupport = 0.004;
constexpr int kNearLabels = 2;
// No range found reaches farther, px per view step.
constexpr double kMaxDisparity = 16;
// Horizontal EPIs looked at; blocks of vertical ones, and how many of them stand side by side.
constexpr int kLines = 96;
constexpr int kBlocks = 12;
constexpr int kColumns = 16;

using Histogram = std::vector<double>;

// Of the pixels looked at, those that reach each coherence but not the one before it.
struct Findings {
  std::array<Histogram, kCoherent.size()> histograms;
  double pixels = 0;

  explicit Findings(double limit) {
    histograms.fill(Histogram(static_cast<std::size_t>(2 * limit / kCell) + 1, 0.0));
  }
  void add(const Findings& other) {
    pixels += other.pixels;
    for (std::size_t level = 0; level < histograms.size(); ++level) {
      add_cells(other.histograms[level], histograms[level]);
    }
  }
  static void add_cells(const Histogram& from, Histogram& to) {
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
    Histogram& histogram = findings.histograms[level - kCoherent.begin()];
    const int cell = static_cast<int>((disparity[i] + limit) / kCell);
    histogram[std::clamp<int>(cell, 0, static_cast<int>(histogram.size()) - 1)] += 1;
  }
}

double total(const Histogram& histogram) {
  return std::accumulate(histogram.begin(), histogram.end(), 0.0);
}

// The disparities of the most coherent pixels, as many as are enough.
Histogram most_coherent(const Findings& findings) {
  Histogram sum = findings.histograms.front();
  for (std::size_t level = 1; level < findings.histograms.size(); ++level) {
    if (total(sum) >= kEnough * findings.pixels) break;
    Findings::add_cells(findings.histograms[level], sum);
  }
  return sum;
}

// Tensors of one EPI alone: neighbours would cost as much again.
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
  const int thickness = horizontal ? 1 : std::min({kColumns, largest.width, lf.width()});
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

// How many cells lie before the first run that holds enough.
template <class Cells>
int cells_to_skip(Cells begin, Cells end, double enough) {
  double sum = 0;
  for (Cells cell = begin; cell != end; ++cell) {
    sum += *cell;
    if (cell - begin >= kRun) sum -= *(cell - kRun);
    if (sum >= enough) return std::max(0, static_cast<int>(cell - begin) + 1 - kRun);
  }
  return 0;
}

// Where the tails end.
Interval ends_of(const Histogram& cells, double tail, double limit) {
  const double low = cells_to_skip(cells.begin(), cells.end(), tail) * kCell - limit;
  const double high = limit + kCell - cells_to_skip(cells.rbegin(), cells.rend(), tail) * kCell;
  return {low, std::min(limit, high)};
}

// Of a label and those beside it.
double sum_of_three(const std::vector<double>& values, int middle) {
  double sum = 0;
  for (int l = std::max(0, middle - 1); l <= middle + 1 && l < std::ssize(values); ++l) {
    sum += values[l];
  }
  return sum;
}

// Leaves out orientations that hardly any pixel confirms by matching: aliases of repeated patterns.
void clear_unsupported(const LightField& lf, Interval range, double limit, Histogram& cells,
                       const Progress& progress) {
  const int count = std::max(2, static_cast<int>(std::ceil(range.length() / kLabelStep)) + 1);
  const std::vector<double> support = label_support(lf, equidistant_labels(range, count), progress);
  const double step = range.length() / (count - 1);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double place = ((static_cast<double>(i) + 0.5) * kCell - limit - range.min) / step;
    const int nearest = static_cast<int>(std::lround(place));
    bool is_supported = false;
    for (int l = nearest - kNearLabels; l <= nearest + kNearLabels; ++l) {
      is_supported = is_supported || sum_of_three(support, l) >= kSupport;
    }
    if (!is_supported) cells[i] = 0;
  }
}

// The largest disparity whose neighbouring views still share most of the image.
double widest_limit(const LightField& lf) {
  const int along = std::min(lf.grid().u > 1 ? lf.width() : lf.height(),
                             lf.grid().v > 1 ? lf.height() : lf.width());
  return std::clamp(along / 6.0, 2.0, kMaxDisparity);
}

}  // namespace

Interval find_disparity_range(const LightField& lf, const Progress& progress) {
  const double limit = widest_limit(lf);
  Findings findings(limit);
  const auto add = [&findings](const std::vector<Findings>& parts) {
    for (const Findings& part : parts) findings.add(part);
  };
  if (lf.grid().u > 1) {
    add(collect(lf, StructureTensor::Direction::Horizontal, limit, progress.part(0, 0.4)));
  }
  if (lf.grid().v > 1) {
    add(collect(lf, StructureTensor::Direction::Vertical, limit, progress.part(0.4, 0.8)));
  }
  Histogram sum = most_coherent(findings);
  constexpr double least = 100;
  if (total(sum) < least) return {-1, 1};
  const double tail = kTail * total(sum);
  const Interval seen = ends_of(sum, tail, limit);
  clear_unsupported(lf, seen, limit, sum, progress.part(0.8, 1));
  return ends_of(sum, tail, limit);
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
  progress.step("disparity range");
  return find_disparity_range(lf, progress);
}

}  // namespace episcope
