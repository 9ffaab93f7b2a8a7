// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/disparity_range.h"

#include "engine/core/parallel.h"
#include "engine/disparity/structure_tensor.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope {
namespace {

// Width of a histogram cell, px per view step.
constexpr double kCell = 0.05;
// Coherence above which an orientation counts.
constexpr float kCoherent = 0.95F;
// Share of the coherent pixels that may lie beyond either end of the range.
constexpr double kTail = 0.002;
// Added to both ends: what the tails and the histogram leave out.
constexpr double kMargin = 0.1;
// EPIs looked at in each direction.
constexpr int kLines = 48;

using Histogram = std::vector<double>;

void add_line(const StructureTensor& tensor, int row, int lanes, int step, double limit,
              Histogram& histogram) {
  const float* disparity = tensor.disparity(row);
  const float* coherence = tensor.coherence(row);
  for (int i = 0; i < lanes; i += step) {
    if (coherence[i] < kCoherent) continue;
    const int cell = static_cast<int>((disparity[i] + limit) / kCell);
    histogram[std::clamp<int>(cell, 0, static_cast<int>(histogram.size()) - 1)] += 1;
  }
}

std::vector<Histogram> collect(const LightField& lf, StructureTensor::Direction direction,
                               double limit, const Progress& progress) {
  const bool horizontal = direction == StructureTensor::Direction::Horizontal;
  const int extent = horizontal ? lf.height() : lf.width();
  const int step = std::max(1, extent / kLines);
  const int count = (extent + step - 1) / step;
  const TensorSearch search = cover_range({-limit, limit}, 2);
  const Histogram empty(static_cast<std::size_t>(2 * limit / kCell) + 1, 0.0);
  std::vector<Histogram> histograms(count, empty);
  const ViewIndex center = lf.center();
  parallel_for_workers(count, progress, [&]() -> std::function<void(int)> {
    auto tensor = std::make_shared<StructureTensor>(lf, direction, TensorScales{}, search);
    return [&, tensor](int i) {
      const int at = std::min(i * step, extent - 1);
      const int row = horizontal ? center.u : center.v;
      const EpiStretch stretch{horizontal ? center.v : center.u, at, row, row + 1};
      const int length = horizontal ? lf.width() : lf.height();
      constexpr int kBand = 128;
      for (int begin = 0; begin < length; begin += horizontal ? length : kBand) {
        const int end = horizontal ? length : std::min(length, begin + kBand);
        tensor->estimate(stretch, begin, end);
        const int lanes = horizontal ? 1 : StructureTensor::kColumns;
        add_line(*tensor, row, (end - begin) * lanes, lanes, limit, histograms[i]);
      }
    };
  });
  return histograms;
}

double quantile_cell(const Histogram& histogram, double share) {
  double total = 0;
  for (const double count : histogram) total += count;
  double sum = 0;
  for (std::size_t i = 0; i < histogram.size(); ++i) {
    sum += histogram[i];
    if (sum > share * total) return static_cast<double>(i);
  }
  return static_cast<double>(histogram.size()) - 1;
}

}  // namespace

Interval find_disparity_range(const LightField& lf, const Progress& progress, double limit) {
  Histogram sum(static_cast<std::size_t>(2 * limit / kCell) + 1, 0.0);
  const auto add = [&sum](const std::vector<Histogram>& histograms) {
    for (const Histogram& histogram : histograms) {
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += histogram[i];
    }
  };
  if (lf.grid().u > 1) {
    add(collect(lf, StructureTensor::Direction::Horizontal, limit, progress.part(0, 0.5)));
  }
  if (lf.grid().v > 1) {
    add(collect(lf, StructureTensor::Direction::Vertical, limit, progress.part(0.5, 1)));
  }
  double total = 0;
  for (const double count : sum) total += count;
  constexpr double enough = 100;
  if (total < enough) return {-1, 1};
  const double low = quantile_cell(sum, kTail) * kCell - limit;
  const double high = (quantile_cell(sum, 1 - kTail) + 1) * kCell - limit;
  return {std::max(-limit, low - kMargin), std::min(limit, high + kMargin)};
}

Interval search_range(const LightField& lf, const IntervalOrAuto& wanted, const Progress& progress) {
  if (wanted) return *wanted;
  if (lf.info().disparity_range) return *lf.info().disparity_range;
  progress.step("disparity range");
  return find_disparity_range(lf, progress);
}

}  // namespace episcope
