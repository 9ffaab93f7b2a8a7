// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/orientation_histogram.h"

#include "engine/core/parallel/parallel.h"
#include "engine/disparity/tensor/structure_tensor.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace episcope {
namespace {

// Coherence above which an orientation counts: the first that enough pixels reach. Noise lowers
// coherence long before it spoils orientations: at 10/255, those above 0.6 still end within 0.3 px
// of the true range. A higher start would exclude regions that are seen less well than others.
constexpr std::array<float, 3> kCoherent{0.8F, 0.7F, 0.6F};
// Share of the pixels that are enough.
constexpr double kEnough = 0.2;
// Cells side by side that make an end of the range.
constexpr int kRun = 4;
// Horizontal EPIs looked at; blocks of vertical ones, and how many of them stand side by side.
constexpr int kLines = 96;
constexpr int kBlocks = 12;
constexpr int kColumns = 16;

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
  const int before = cells_to_skip(cells_.begin(), cells_.end(), enough);
  if (before == size()) return {};
  const int behind = cells_to_skip(cells_.rbegin(), cells_.rend(), enough);
  return Interval{before * kCell - limit_, std::min(limit_, limit_ + kCell - behind * kCell)};
}

}  // namespace episcope
