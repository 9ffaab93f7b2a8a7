// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo.h"

#include "engine/core/text.h"
#include "engine/disparity/kernels/shared_constants.h"
#include "engine/disparity/view_samples.h"
#include "engine/disparity/visible_costs.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace episcope {
namespace {

// Chooses labels row by row.
class Winners {
 public:
  Winners(const StereoCosts& costs, Refinement refinement, int width)
      : refinement_(refinement),
        first_(costs.labels.front()),
        step_(costs.labels[1] - costs.labels[0]),
        best_(width),
        least_(width),
        sum_(width) {}

  void choose(VolumeView<const float> costs, int y, float* disparity, float* confidence) {
    find_least(costs, y);
    const auto layers = static_cast<float>(costs.layers);
    for (int x = 0; x < costs.width; ++x) {
      const int label = best_[x];
      float place = static_cast<float>(label);
      if (label > 0 && label + 1 < costs.layers) {
        place += sub_label_offset(costs.at(y, label - 1, x), least_[x], costs.at(y, label + 1, x),
                                  refinement_);
      }
      disparity[x] = first_ + place * step_;
      const float mean = sum_[x] / layers;
      confidence[x] = std::clamp((mean - least_[x]) / (mean + kFlatCost), 0.0F, 1.0F);
    }
  }

 private:
  void find_least(VolumeView<const float> costs, int y) {
    std::fill(best_.begin(), best_.end(), 0);
    std::fill(least_.begin(), least_.end(), std::numeric_limits<float>::infinity());
    std::fill(sum_.begin(), sum_.end(), 0.0F);
    for (int label = 0; label < costs.layers; ++label) {
      const float* cost = costs.row(y, label);
      for (int x = 0; x < costs.width; ++x) {
        sum_[x] += cost[x];
        best_[x] = cost[x] < least_[x] ? label : best_[x];
        least_[x] = cost[x] < least_[x] ? cost[x] : least_[x];
      }
    }
  }

  Refinement refinement_;
  float first_;
  float step_;
  std::vector<int> best_;
  std::vector<float> least_, sum_;
};

void choose_labels(const LightField& lf, const StereoCosts& costs, Refinement refinement,
                   Estimate& estimate, const Progress& progress) {
  const ImageView<float> disparity = estimate.field.disparity.view(costs.view);
  const ImageView<float> confidence = estimate.confidence.view(costs.view);
  progress.step("matching costs");
  compute_stereo_costs(
      lf, costs,
      [&](int y, VolumeView<const float> band) {
        Winners winners(costs, refinement, lf.width());
        for (int row = 0; row < band.height; ++row) {
          winners.choose(band, row, disparity.row(y + row), confidence.row(y + row));
        }
      },
      progress);
}

void choose_on_device(const LightField& lf, const StereoCosts& costs, Refinement refinement,
                      Estimate& estimate, const Progress& progress) {
  const LightField& compared = costs.relative ? *costs.relative : lf;
  costs.matcher->choose(
      device_matching(compared, costs.view, costs.matching, costs.labels),
      {costs.labels.front(), costs.labels[1] - costs.labels[0], device_refinement(refinement)},
      estimate.field.disparity.view(costs.view), estimate.confidence.view(costs.view), progress);
}

// The profile `paper` has no refinement, weights neither data nor variation, and leaves islands; λ
// = 0.2.
Schema<StereoLocalParameters> stereo_local_schema(MatchedViews views) {
  using P = StereoLocalParameters;
  return Schema<P>()
      .part(&P::matching, stereo_cost_schema(views))
      .choice("refinement", &P::refinement,
              {"Refinement", "How the disparity is interpolated between labels"})
      .begin_with(kProfileKey)
      .search("epsilon", {0, 0.01, 0.02, 0.05, 0.1, kUncapped})
      .search("aggregation", {0, 2})
      .preset(kProfileKey, kPaperProfile, {{"refinement", std::string("none")}});
}

Schema<StereoSmoothParameters> stereo_smooth_schema(MatchedViews views) {
  using P = StereoSmoothParameters;
  // Fewer caps than for the local methods: smoothing removes the noise that they leave.
  return Schema<P>()
      .part(&P::denoising, denoise_schema())
      .real(
          "map_noise", &P::map_noise,
          {"Map noise σ₀",
           "Where neighboring disparities scatter less than this, in px, the data term gets more "
           "weight, so that slopes are not flattened; 0 treats all pixels alike, as in the paper"},
          {0, 1})
      .part(&P::islands, island_schema())
      .part(&P::local, stereo_local_schema(views))
      .begin_with(kProfileKey)
      .search("lambda", {0.02, 0.05, 0.1, 0.2, 0.4})
      .search("weight_power", {0, 2})
      .search("epsilon", {0, 0.02, kUncapped})
      .search("aggregation", {0, 2})
      .preset(kProfileKey, kPaperProfile, plain_denoising())
      .preset(kProfileKey, kPaperProfile, plain_islands())
      .preset(kProfileKey, kPaperProfile, {{"lambda", 0.2}, {"map_noise", 0.0}})
      .preset_search(kProfileKey, kPaperProfile, "lambda", {0.02, 0.05, 0.1, 0.2, 0.4, 0.8});
}

void label_stereo(const LightField& lf, const StereoCosts& stereo,
                  const GlobalLabelingParameters& labeling, Estimate& estimate,
                  const Progress& progress) {
  const Volume<float> volume = stereo_volume(lf, stereo, progress.part(0, 0.26));
  const VolumeView<const float> costs = volume.view();
  const Image<float> means = mean_costs(costs, progress.part(0.26, 0.27));
  const auto place = [&](const Image<int>& labels, const Progress& part) {
    return place_pixels(
        labels,
        [&](int y, int x, int label) { return place_by_costs(stereo, costs, means, y, x, label); },
        part);
  };
  const float step = stereo.labels[1] - stereo.labels[0];
  const double scale = cost_unit(lf, stereo.view, costs, step, progress.part(0.27, 0.28));
  const double noise = view_noise_variance(lf, stereo.view, progress.part(0.28, 0.281));
  label_globally(lf, {stereo.view, stereo.labels, costs, scale, place, noise, {}}, labeling,
                 estimate, progress.part(0.281, 0.99));
  estimate.confidence = volume_confidence(estimate.field.disparity.view(stereo.view), stereo, costs,
                                          means, progress.part(0.99, 1));
}

void label_on_device(const LightField& lf, const StereoCosts& stereo,
                     const GlobalLabelingParameters& labeling, Estimate& estimate,
                     const Progress& progress) {
  const LightField& compared = stereo.relative ? *stereo.relative : lf;
  const cuda::SharedVolume costs =
      stereo.matcher->volume(device_matching(compared, stereo.view, stereo.matching, stereo.labels),
                             progress.part(0, 0.26));
  const auto place = [&](const Image<int>& labels, const Progress& part) {
    return place_by_costs(stereo, *costs, labels, part);
  };
  const float step = stereo.labels[1] - stereo.labels[0];
  const double scale = cost_unit(lf, stereo.view, *costs, step, progress.part(0.26, 0.28));
  const double noise = stereo.matcher->noise_variance(progress.part(0.28, 0.281));
  label_globally(lf, {stereo.view, stereo.labels, {}, scale, place, noise, costs}, labeling,
                 estimate, progress.part(0.281, 0.99));
  estimate.confidence = volume_confidence(estimate.field.disparity.view(stereo.view), stereo,
                                          *costs, progress.part(0.99, 1));
}

// A function of `views` in the form that make_estimator takes.
template <class P, class F>
auto with_views(MatchedViews views, F function) {
  return [=](const LightField& light_field, const P& parameters, ViewSelection,
             const Progress& progress, auto... device) {
    return function(light_field, views, parameters, progress, device...);
  };
}

// "ST_AV_" or "ST_CH_", followed by the kind of method.
std::string name_of(MatchedViews views, char kind) {
  return std::string(views == MatchedViews::All ? "ST_AV_" : "ST_CH_") + kind;
}

EstimatorInfo stereo_info(MatchedViews views, char kind, std::string summary,
                          std::vector<std::string> main_parameters) {
  const std::string name = name_of(views, kind);
  return {.id = lower_case(name),
          .name = name,
          .summary = std::move(summary),
          .reference = "Wanner, Meister and Goldluecke 2013 [WMG13]",
          .iterative = kind != 'L',
          .revision = kind == 'L' ? 6 : 7,
          .devices = {Device::Cpu, Device::Cuda},
          .main_parameters = std::move(main_parameters)};
}

}  // namespace

Estimate estimate_stereo_local(const LightField& lf, MatchedViews views,
                               const StereoLocalParameters& parameters, const Progress& progress,
                               Device device) {
  const StereoCosts costs =
      prepare_stereo(lf, views, parameters.matching, progress.part(0, 0.1), device);
  Estimate estimate;
  estimate.range = costs.range;
  estimate.field.disparity = ViewStack<float>({1, 1}, lf.height(), lf.width(), 1, costs.view);
  estimate.confidence = ViewStack<float>({1, 1}, lf.height(), lf.width(), 1, costs.view);
  const auto choose = costs.matcher ? choose_on_device : choose_labels;
  choose(lf, costs, parameters.refinement, estimate, progress.part(0.1, 1));
  estimate.notes = cost_notes(costs);
  return estimate;
}

Estimate estimate_stereo_smooth(const LightField& lf, MatchedViews views,
                                const StereoSmoothParameters& parameters, const Progress& progress,
                                Device device) {
  Estimate estimate =
      estimate_stereo_local(lf, views, parameters.local, progress.part(0, 0.85), device);
  denoise(lf, parameters.denoising, estimate, progress.part(0.85, 1), DataWeight{}.minimum,
          static_cast<float>(parameters.map_noise), device);
  ViewStack<float>& maps = estimate.field.disparity;
  fill_islands(parameters.islands, progress.part(1, 1), maps.view(maps.first()));
  return estimate;
}

Schema<StereoGlobalParameters> stereo_global_schema(MatchedViews views) {
  using P = StereoGlobalParameters;
  return Schema<P>()
      .part(&P::labeling, global_labeling_schema())
      .part(&P::matching, stereo_cost_schema(views))
      .part(&P::islands, island_schema())
      .begin_with(kProfileKey)
      .search("smoothness", {0.3, 0.6, 1.2, 2.4, 5, 10})
      .search("edge_strength", {0, 25})
      .search("epsilon", {0, 0.02, 0.05, kUncapped})
      .preset(kProfileKey, kPaperProfile, plain_labeling())
      .preset(kProfileKey, kPaperProfile, plain_islands())
      .preset(kProfileKey, kPaperProfile, {{"smoothness", kPaperSmoothness}})
      .preset_search(kProfileKey, kPaperProfile, "smoothness",
                     {0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.2, 1.6, 2.4});
}

Estimate estimate_stereo_global(const LightField& lf, MatchedViews views,
                                const StereoGlobalParameters& parameters, const Progress& progress,
                                Device device) {
  const StereoCosts stereo =
      prepare_stereo(lf, views, parameters.matching, progress.part(0, 0.05), device);
  progress.step("matching costs");
  Estimate estimate;
  estimate.range = stereo.range;
  estimate.notes = cost_notes(stereo);
  const auto label = stereo.matcher ? label_on_device : label_stereo;
  label(lf, stereo, parameters.labeling, estimate, progress.part(0.05, 1));
  fill_islands(parameters.islands, progress.part(1, 1), estimate.field.disparity.view(stereo.view));
  return estimate;
}

Estimator stereo_local_estimator(MatchedViews views) {
  using P = StereoLocalParameters;
  const std::string used = views == MatchedViews::All ? "all views" : "the views of the cross-hair";
  return make_estimator<P>(stereo_info(views, 'L', "Local multi-view stereo over " + used,
                                       {"range", "labels", "aggregation"}),
                           stereo_local_schema(views), with_views<P>(views, estimate_stereo_local));
}

Estimator stereo_smooth_estimator(MatchedViews views) {
  using P = StereoSmoothParameters;
  return make_estimator<P>(
      stereo_info(views, 'S', name_of(views, 'L') + ", denoised with total variation (TV-L2)",
                  {"range", "labels", "lambda"}),
      stereo_smooth_schema(views), with_views<P>(views, estimate_stereo_smooth));
}

Estimator stereo_global_estimator(MatchedViews views) {
  using P = StereoGlobalParameters;
  return make_estimator<P>(
      stereo_info(views, 'G',
                  "Globally optimal labeling of the matching costs of " + name_of(views, 'L'),
                  {"range", "labels", "smoothness"}),
      stereo_global_schema(views), with_views<P>(views, estimate_stereo_global));
}

}  // namespace episcope
