// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/visible_costs.h"

#include "engine/core/parallel.h"
#include "engine/cuda/stereo_matcher.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/view_samples.h"
#include "engine/solvers/layered_sweep.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace episcope {
namespace {

// Sums over the channels of products of the gradient.
struct Products {
  float xx = 0, xy = 0, yy = 0;
};

Products gradient_products(const Image<float>& image, int y, int x) {
  const int left = std::max(x - 1, 0), right = std::min(x + 1, image.width() - 1);
  const int up = std::max(y - 1, 0), down = std::min(y + 1, image.height() - 1);
  Products sum;
  for (int c = 0; c < image.channels(); ++c) {
    const float gx = (image.at(y, right, c) - image.at(y, left, c)) / std::max(right - left, 1);
    const float gy = (image.at(down, x, c) - image.at(up, x, c)) / std::max(down - up, 1);
    sum.xx += gx * gx;
    sum.xy += gx * gy;
    sum.yy += gy * gy;
  }
  return sum;
}

float mean_difference(const Products& g, GridShape grid, ViewIndex view) {
  float sum = 0;
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex other = grid.view_at(i);
    const auto u = static_cast<float>(other.u - view.u), v = static_cast<float>(other.v - view.v);
    sum += std::sqrt(std::max(0.0F, u * u * g.xx + 2 * u * v * g.xy + v * v * g.yy));
  }
  return sum / static_cast<float>(grid.count() - 1);
}

constexpr int kTrustRadius = 4;

// Between a view that counts and one that does not, px of disparity.
constexpr float kSoftness = 0.05F;

// Of the view, which is compensated.
Image<float> noise_of(const StereoCosts& costs, const Progress& progress) {
  if (costs.matcher) return costs.matcher->noise(progress);
  return costs.matching.noise ? *costs.matching.noise : Image<float>();
}

LabelCosts costs_on_device(const LightField& lf, const StereoCosts& costs,
                           const Progress& progress) {
  const LightField& compared = costs.relative ? *costs.relative : lf;
  return {costs,
          costs.matcher->volume(device_matching(compared, costs.view, costs.matching, costs.labels),
                                progress)};
}

// How far around the best label costs are looked at.
constexpr double kUnitReach = 0.5;  // px

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

// 1 − cost / mean cost, in [0, 1]; 0 without costs.
float cost_trust(float cost, float mean) {
  return mean > 0 ? std::clamp(1 - cost / mean, 0.0F, 1.0F) : 0;
}

}  // namespace

Image<float> local_caps(const LightField& lf, ViewIndex view, const Image<float>& variance,
                        const LocalCapOptions& options, const Progress& progress) {
  const Image<float> image = lf.view_as_float(view);
  const auto of_channels = static_cast<float>(1 / std::sqrt(channel_weight(lf.channels())));
  const float lowest = of_channels * options.lowest, highest = of_channels * options.highest;
  Image<float> caps(lf.height(), lf.width());
  parallel_for(lf.height(), progress, [&](int y) {
    for (int x = 0; x < lf.width(); ++x) {
      const float off =
          options.offset * mean_difference(gradient_products(image, y, x), lf.grid(), view);
      const float noise = std::sqrt(variance.at(y, x) * static_cast<float>(lf.channels()));
      caps.at(y, x) = std::clamp(off, lowest, highest) + options.noise_share * noise;
    }
  });
  return caps;
}

Image<float> regional_trust(ImageView<const float> confidence) {
  const int height = confidence.height, width = confidence.width;
  Image<float> own(height, width), means(height, width);
  for (int y = 0; y < height; ++y) std::copy_n(confidence.row(y), width, own.row(y));
  std::vector<float> columns(width);
  for (int y = 0; y < height; ++y) {
    window_mean_row(own, y, kTrustRadius, columns.data(), means.row(y));
  }
  return means;
}

LabelCosts::LabelCosts(const StereoCosts& stereo, Volume<float> volume, const Progress& progress)
    : stereo_(stereo),
      volume_(std::move(volume)),
      means_(mean_costs(std::as_const(volume_).view(), progress)) {}

LabelCosts::LabelCosts(const StereoCosts& stereo, cuda::SharedVolume volume)
    : stereo_(stereo), on_device_(std::move(volume)) {}

Image<int> LabelCosts::best_labels(const Progress& progress) const {
  if (on_device_) return cuda::least_labels(*on_device_, progress);
  const VolumeView<const float> costs = on_cpu();
  Image<int> labels(costs.height, costs.width);
  parallel_for(costs.height, progress, [&](int y) {
    std::vector<float> least;
    take_cheapest(costs, y, labels.row(y), least);
  });
  return labels;
}

Placements LabelCosts::place(const Image<int>& labels, const Progress& progress) const {
  if (on_device_) return place_by_costs(stereo_, *on_device_, labels, progress);
  return place_pixels(
      labels,
      [&](int y, int x, int label) {
        return place_by_costs(stereo_, on_cpu(), means_, y, x, label);
      },
      progress);
}

ViewStack<float> LabelCosts::confidence(ImageView<const float> disparity,
                                        const Progress& progress) const {
  if (on_device_) return volume_confidence(disparity, stereo_, *on_device_, progress);
  return volume_confidence(disparity, stereo_, on_cpu(), means_, progress);
}

Schema<VisibilityParameters> visibility_schema() {
  using P = VisibilityParameters;
  return Schema<P>()
      .integer("rounds", &P::rounds,
               {"Visibility rounds",
                "Number of times the costs are computed again without the views in which the "
                "last result says a point is occluded; 0 = off"},
               {0, 10})
      .real("tolerance", &P::tolerance,
            {"Occlusion tolerance", "A surface nearer than a point by more than this occludes it",
             "px"},
            {0, 2})
      .real("least_trust", &P::least_trust,
            {"Occluder confidence",
             "A surface whose confidence is below this, mean over its surroundings, occludes "
             "nothing"},
            {0, 1})
      .real("cap_share", &P::cap_share,
            {"Minimum cost cap", "The smallest cap of a pixel, as a share of ε"}, {0, 10})
      .real("cap_offset", &P::cap_offset,
            {"Cost cap offset",
             "The cap of a pixel follows what a disparity that is off by this much costs there; 0 "
             "uses ε for all pixels",
             "px"},
            {0, 2});
}

void set_local_caps(const LightField& lf, const VisibilityParameters& parameters,
                    const Progress& progress, StereoCosts& costs) {
  if (parameters.cap_offset <= 0) return;
  const Image<float> noise = noise_of(costs, progress.part(0, 0));
  if (noise.empty()) return;
  auto caps = std::make_shared<Image<float>>(local_caps(
      lf, costs.view, noise, {.offset = static_cast<float>(parameters.cap_offset)}, progress));
  const auto least = static_cast<float>(parameters.cap_share * costs.matching.cap);
  for (float& cap : *caps) cap = std::max(cap, least);
  if (costs.matcher) costs.matcher->set_caps(*caps, progress.part(1, 1));
  costs.matching.caps = std::move(caps);
}

Image<float> sure_surfaces(ImageView<const float> disparity, ImageView<const float> confidence,
                           double least_trust) {
  const Image<float> trust = regional_trust(confidence);
  Image<float> known(disparity.height, disparity.width, 1, kNothingNear);
  for (int y = 0; y < disparity.height; ++y) {
    for (int x = 0; x < disparity.width; ++x) {
      if (trust.at(y, x) >= least_trust) known.at(y, x) = disparity.at(y, x);
    }
  }
  return known;
}

void set_occluders(const LightField& lf, ImageView<const float> disparity,
                   ImageView<const float> confidence, const VisibilityParameters& parameters,
                   const Progress& progress, StereoCosts& costs) {
  const Image<float> known = sure_surfaces(disparity, confidence, parameters.least_trust);
  if (costs.matcher) {
    return costs.matcher->set_occluders(known, static_cast<float>(parameters.tolerance), kSoftness,
                                        progress);
  }
  auto occluders = std::make_shared<Occluders>();
  occluders->nearest = surfaces_in_views(known, costs.view, lf.grid(), progress);
  occluders->tolerance = static_cast<float>(parameters.tolerance);
  occluders->softness = kSoftness;
  costs.matching.occluders = std::move(occluders);
}

LabelCosts visible_costs(const LightField& lf, const StereoCosts& costs, const Progress& progress) {
  if (costs.matcher) return costs_on_device(lf, costs, progress);
  Volume<float> volume = stereo_volume(lf, costs, progress.part(0, 0.9));
  if (!costs.matching.caps) return {costs, std::move(volume), progress.part(0.95, 1)};
  const Image<float>& caps = *costs.matching.caps;
  const auto mean = static_cast<float>(std::accumulate(caps.begin(), caps.end(), 0.0) /
                                       static_cast<double>(caps.size()));
  const VolumeView<float> view = volume.view();
  parallel_for(view.height, progress.part(0.9, 0.95), [&](int y) {
    const float* const cap = caps.row(y);
    for (int label = 0; label < view.layers; ++label) {
      float* const cost = view.row(y, label);
      for (int x = 0; x < view.width; ++x) cost[x] *= mean / cap[x];
    }
  });
  return {costs, std::move(volume), progress.part(0.95, 1)};
}

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
