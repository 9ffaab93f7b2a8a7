// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/label_support.h"

#include "engine/core/array/volume.h"
#include "engine/core/parallel/parallel.h"
#include "engine/disparity/common/box_mean.h"
#include "engine/disparity/common/matching_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace episcope {
namespace {

constexpr int kRows = 64;
// Pixels matched together: 3×3.
constexpr int kRadius = 1;
// Beyond it a view does not show the point.
constexpr double kCap = 0.3;
// Labels nearer to the best one than that do not compete with it, px per view step.
constexpr float kApart = 0.75F;
// The best label costs at most this fraction of the next, and less by this, in samples of [0, 1].
constexpr float kRatio = 0.8F;
constexpr float kContrast = 0.004F;

// Costs of one row, `[label][x]`, averaged over the rows and columns around it.
class WindowCosts {
 public:
  WindowCosts(const LightField& lf, const std::vector<float>& labels)
      : matching_(lf, lf.center(), {MatchedViews::CrossHair, Interpolation::Bilinear, kCap},
                  labels),
        rows_(2 * kRadius + 1, static_cast<int>(labels.size()), lf.width()),
        sums_(lf.width()),
        means_(static_cast<int>(labels.size()), lf.width()),
        height_(lf.height()) {}

  const Image<float>& compute(int y, const Progress& progress) {
    const int count = std::min(2 * kRadius + 1, height_);
    const int first = std::clamp(y - kRadius, 0, height_ - count);
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
      box_mean_row(sums_.data(), means_.width(), kRadius, means_.row(l));
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

// Adds the pixels of a row to the labels that they distinctly match.
void count_distinct(const Image<float>& costs, const std::vector<float>& labels,
                    const LightField& lf, int y, double* counts) {
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
    if (is_distinct && lf.is_valid(lf.center(), y, x)) counts[best[x]] += 1;
  }
}

}  // namespace

std::vector<double> label_support(const LightField& lf, const std::vector<float>& labels,
                                  const Progress& progress) {
  const int count = static_cast<int>(labels.size());
  const int rows = std::min(kRows, lf.height());
  std::vector<double> counts(static_cast<std::size_t>(rows) * count);
  parallel_for_workers(rows, progress, [&] {
    return [&, costs = WindowCosts(lf, labels)](int i) mutable {
      const int y = rows > 1 ? i * (lf.height() - 1) / (rows - 1) : 0;
      count_distinct(costs.compute(y, progress), labels, lf, y,
                     counts.data() + static_cast<std::size_t>(i) * count);
    };
  });
  std::vector<double> shares(count);
  for (std::size_t i = 0; i < counts.size(); ++i) shares[i % count] += counts[i];
  const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
  for (double& share : shares) share /= std::max(total, 1.0);
  return shares;
}

}  // namespace episcope
