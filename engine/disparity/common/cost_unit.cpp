// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/cost_unit.h"

#include "engine/core/parallel/parallel.h"
#include "engine/cuda/stereo/volume_costs.h"
#include "engine/disparity/common/invalid_pixels.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace episcope {
namespace {

// How far around the best label costs are looked at.
constexpr double kReach = 0.5;  // px

// The label of least cost at each pixel of a row.
void find_best(VolumeView<const float> costs, int y, std::vector<float>& least,
               std::vector<int>& best) {
  std::copy_n(costs.row(y, 0), costs.width, least.data());
  std::fill(best.begin(), best.end(), 0);
  for (int l = 1; l < costs.layers; ++l) {
    const float* const cost = costs.row(y, l);
    for (int x = 0; x < costs.width; ++x) {
      best[x] = cost[x] < least[x] ? l : best[x];
      least[x] = std::min(least[x], cost[x]);
    }
  }
}

// The mean cost around the best label, of one pixel.
double mean_around(VolumeView<const float> costs, int y, int x, int best, int reach) {
  const int first = std::max(0, best - reach);
  const int last = std::min(costs.layers - 1, best + reach);
  double sum = 0;
  for (int l = first; l <= last; ++l) sum += costs.at(y, l, x);
  return sum / (last - first + 1);
}

// Labels on either side of the best one that count.
int reach_of(double step) {
  return std::max(1, static_cast<int>(std::lround(kReach / step)));
}

double per_valid_pixel(double sum, const LightField& lf, ViewIndex view) {
  return sum / static_cast<double>(std::max<std::size_t>(1, count_valid(lf, view)));
}

}  // namespace

double cost_unit(const LightField& lf, ViewIndex view, VolumeView<const float> costs, double step,
                 const Progress& progress) {
  const int reach = reach_of(step);
  std::vector<double> sums(costs.height);
  parallel_for_workers(costs.height, progress, [&] {
    return [&, least = std::vector<float>(costs.width),
            best = std::vector<int>(costs.width)](int y) mutable {
      find_best(costs, y, least, best);
      for (int x = 0; x < costs.width; ++x) {
        if (lf.is_valid(view, y, x)) sums[y] += mean_around(costs, y, x, best[x], reach);
      }
    };
  });
  return per_valid_pixel(std::accumulate(sums.begin(), sums.end(), 0.0), lf, view);
}

double cost_unit(const LightField& lf, ViewIndex view, const cuda::DeviceVolume& costs, double step,
                 const Progress& progress) {
  const std::uint8_t* const valid = lf.valid().empty() ? nullptr : lf.valid().view(view).data;
  return per_valid_pixel(cuda::sum_around_best(costs, valid, reach_of(step), progress), lf, view);
}

}  // namespace episcope
