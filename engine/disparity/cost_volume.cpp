// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/cost_volume.h"

#include "engine/core/parallel.h"
#include "engine/cuda/volume_costs.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/global_labeling.h"
#include "engine/solvers/pair_limits.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace episcope {
namespace {

// How far around the best label costs are looked at.
constexpr double kUnitReach = 0.5;  // px

// The mean cost around the best label, of one pixel.
double mean_around(VolumeView<const float> costs, int y, int x, int best, int reach) {
  const int first = std::max(0, best - reach);
  const int last = std::min(costs.layers - 1, best + reach);
  double sum = 0;
  for (int l = first; l <= last; ++l) sum += costs.at(y, l, x);
  return sum / (last - first + 1);
}

// Labels on either side of the best one that count.
int unit_labels(double step) {
  return std::max(1, static_cast<int>(std::lround(kUnitReach / step)));
}

double per_valid_pixel(double sum, const LightField& lf, ViewIndex view) {
  return sum / static_cast<double>(std::max<std::size_t>(1, count_valid(lf, view)));
}

}  // namespace

double cost_unit(const LightField& lf, ViewIndex view, VolumeView<const float> costs, double step,
                 const Progress& progress) {
  const int reach = unit_labels(step);
  std::vector<double> sums(costs.height);
  parallel_for_workers(costs.height, progress, [&] {
    return [&, least = std::vector<float>(), best = std::vector<int>(costs.width)](int y) mutable {
      take_cheapest(costs, y, best.data(), least);
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
  return per_valid_pixel(cuda::sum_around_best(costs, valid, unit_labels(step), progress), lf,
                         view);
}

namespace {

// No pixel gets weight 0 when it is placed between labels.
constexpr float kPlacedMinWeight = 0.01F;

float step_of(const StereoCosts& stereo) {
  return stereo.labels[1] - stereo.labels[0];
}

// `offset` in labels.
Placement placed(const StereoCosts& stereo, int label, float offset, float trust) {
  return {stereo.labels[label] + offset * step_of(stereo),
          std::max(trust * trust, kPlacedMinWeight)};
}

bool is_between(const StereoCosts& stereo, int label) {
  return label > 0 && label + 1 < static_cast<int>(stereo.labels.size());
}

int nearest_label(const StereoCosts& stereo, float disparity) {
  const float place = (disparity - stereo.labels.front()) / step_of(stereo);
  return std::clamp(static_cast<int>(place + 0.5F), 0, static_cast<int>(stereo.labels.size()) - 1);
}

}  // namespace

Image<float> mean_costs(VolumeView<const float> costs, const Progress& progress) {
  Image<float> means(costs.height, costs.width);
  parallel_for(costs.height, progress, [&](int y) {
    float* const mean = means.row(y);
    for (int l = 0; l < costs.layers; ++l) {
      const float* const cost = costs.row(y, l);
      for (int x = 0; x < costs.width; ++x) mean[x] += cost[x];
    }
    for (int x = 0; x < costs.width; ++x) mean[x] /= static_cast<float>(costs.layers);
  });
  return means;
}

float cost_trust(float cost, float mean) {
  return mean > 0 ? std::clamp(1 - cost / mean, 0.0F, 1.0F) : 0;
}

Placement place_by_costs(const StereoCosts& stereo, VolumeView<const float> costs,
                         const Image<float>& means, int y, int x, int label) {
  const float cost = costs.at(y, label, x);
  const float trust = cost_trust(cost, means.at(y, x));
  float offset = 0;
  if (is_between(stereo, label)) {
    offset = sub_label_offset(costs.at(y, label - 1, x), cost, costs.at(y, label + 1, x),
                              Refinement::Parabola);
  }
  return placed(stereo, label, offset, trust);
}

Placements place_by_costs(const StereoCosts& stereo, const cuda::DeviceVolume& costs,
                          const Image<int>& labels, const Progress& progress) {
  const cuda::CostsAtLabels at = cuda::costs_at_labels(costs, labels, progress);
  const auto place = [&](int y, int x, int label) {
    const float cost = at.here.at(y, x);
    const float offset =
        is_between(stereo, label)
            ? sub_label_offset(at.before.at(y, x), cost, at.after.at(y, x), Refinement::Parabola)
            : 0;
    return placed(stereo, label, offset, cost_trust(cost, at.mean.at(y, x)));
  };
  return place_pixels(labels, place, progress);
}

ViewStack<float> volume_confidence(ImageView<const float> disparity, const StereoCosts& stereo,
                                   VolumeView<const float> costs, const Image<float>& means,
                                   const Progress& progress) {
  ViewStack<float> confidence({1, 1}, costs.height, costs.width, 1, stereo.view);
  const ImageView<float> map = confidence.view(stereo.view);
  parallel_for(costs.height, progress, [&](int y) {
    for (int x = 0; x < costs.width; ++x) {
      const int label = nearest_label(stereo, disparity.at(y, x));
      map.at(y, x) = cost_trust(costs.at(y, label, x), means.at(y, x));
    }
  });
  return confidence;
}

ViewStack<float> volume_confidence(ImageView<const float> disparity, const StereoCosts& stereo,
                                   const cuda::DeviceVolume& costs, const Progress& progress) {
  Image<int> labels(disparity.height, disparity.width);
  parallel_for(disparity.height, progress, [&](int y) {
    for (int x = 0; x < disparity.width; ++x) {
      labels.at(y, x) = nearest_label(stereo, disparity.at(y, x));
    }
  });
  const cuda::CostsAtLabels at = cuda::costs_at_labels(costs, labels, progress);
  ViewStack<float> confidence({1, 1}, disparity.height, disparity.width, 1, stereo.view);
  std::transform(at.here.begin(), at.here.end(), at.mean.begin(), confidence.data(), cost_trust);
  return confidence;
}

double mean_of_valid(const Image<float>& image, const LightField& lf, ViewIndex view) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) sum += lf.is_valid(view, y, x) ? image.at(y, x) : 0;
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, count_valid(lf, view)));
}

}  // namespace episcope
