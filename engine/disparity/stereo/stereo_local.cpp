// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo/stereo_local.h"

#include "engine/core/parallel/parallel.h"
#include "engine/disparity/stereo/stereo_on_device.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace episcope {
namespace {

// Mean costs this small are meaningless: a twentieth of the step of 8-bit samples.
constexpr float kFlat = 2e-4F;

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
      confidence[x] = std::clamp((mean - least_[x]) / (mean + kFlat), 0.0F, 1.0F);
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

// The maps of some rows of the view that the costs are of.
BlockMaps choose_labels(const LightField& lf, const StereoCosts& costs, Refinement refinement,
                        const MapBlock& block, const Progress& progress) {
  BlockMaps maps{{{{1, 1}, block.rows(), lf.width(), 1, costs.view}, {}},
                 {{1, 1}, block.rows(), lf.width(), 1, costs.view}};
  const ImageView<float> disparity = maps.field.disparity.view(costs.view);
  const ImageView<float> confidence = maps.confidence.view(costs.view);
  const int rows = stereo_band_rows(block.rows());
  const int bands = (block.rows() + rows - 1) / rows;
  progress.step("matching costs");
  parallel_for_workers(bands, progress, [&] {
    return [&, source = StereoCostRows(lf, costs),
            winners = Winners(costs, refinement, lf.width())](int i) mutable {
      const int y = i * rows;
      const auto band =
          source.compute(block.first_row + y, std::min(rows, block.rows() - y), progress);
      for (int row = 0; row < band.height; ++row) {
        winners.choose(band, row, disparity.row(y + row), confidence.row(y + row));
      }
    };
  });
  return maps;
}

void choose_on_device(const LightField& lf, const StereoCosts& costs, Refinement refinement,
                      Estimate& estimate, const Progress& progress) {
  const LightField& compared = costs.relative ? *costs.relative : lf;
  costs.matcher->choose(
      device_matching(compared, costs.view, costs.matching, costs.labels),
      {costs.labels.front(), costs.labels[1] - costs.labels[0], device_refinement(refinement)},
      estimate.field.disparity.view(costs.view), estimate.confidence.view(costs.view), progress);
}

// The guide and the noise of the view, volumes of costs of every thread, and the samples around a
// band, of all views that are matched.
double band_bytes(const LightField& lf, const StereoCosts& costs, int rows, int threads) {
  constexpr double kOfView = 64, kMaps = 9, kCost = 4, kMostBandRows = 64 + 32;
  const double width = lf.width(), pixels = width * lf.height();
  const double volumes = kCost * kMostBandRows * width * static_cast<double>(costs.labels.size());
  return kOfView * pixels + kMaps * width * rows + volumes * threads +
         looked_at_bytes(lf, costs, rows);
}

}  // namespace

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
          {"Noise of the map σ₀",
           "Where neighbouring disparities scatter less than this, in px, the data term gets more "
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

Estimate estimate_stereo_local(const LightField& lf, MatchedViews views,
                               const StereoLocalParameters& parameters, const Progress& progress,
                               Device device) {
  const StereoCosts costs =
      prepare_stereo(lf, views, parameters.matching, progress.part(0, 0.1), device);
  Estimate estimate;
  estimate.range = costs.range;
  if (costs.matcher) {
    estimate.field.disparity = ViewStack<float>({1, 1}, lf.height(), lf.width(), 1, costs.view);
    estimate.confidence = ViewStack<float>({1, 1}, lf.height(), lf.width(), 1, costs.view);
    choose_on_device(lf, costs, parameters.refinement, estimate, progress.part(0.1, 1));
  } else {
    BlockMaps maps = choose_labels(lf, costs, parameters.refinement,
                                   {{costs.view, {1, 1}}, 0, lf.height()}, progress.part(0.1, 1));
    estimate.field = std::move(maps.field);
    estimate.confidence = std::move(maps.confidence);
  }
  estimate.notes = cost_notes(costs);
  return estimate;
}

BlockwiseRun stereo_local_in_blocks(const LightField& lf, MatchedViews views,
                                    const StereoLocalParameters& parameters,
                                    const Progress& progress) {
  const auto costs =
      std::make_shared<const StereoCosts>(prepare_stereo(lf, views, parameters.matching, progress));
  BlockwiseRun run;
  run.maps = {{1, 1}, costs->view, lf.height(), lf.width()};
  run.provenance.range = costs->range;
  run.provenance.notes = cost_notes(*costs);
  BlockPass pass;
  pass.step = "matching costs";
  pass.bytes = [&lf, costs, threads = progress.threads()](int rows) {
    return band_bytes(lf, *costs, rows, threads);
  };
  pass.compute = [&lf, costs, refinement = parameters.refinement](
                     const MapBlock& block, const ReadBlock&, const std::vector<double>&,
                     const Progress& part) {
    if (costs->matching.views == MatchedViews::All) {
      lf.fetch_samples(block.first_row, block.end_row);
    }
    return FinishedBlock{choose_labels(lf, *costs, refinement, block, part)};
  };
  run.passes.push_back(std::move(pass));
  return run;
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

BlockwiseRun stereo_smooth_in_blocks(const LightField& lf, MatchedViews views,
                                     const StereoSmoothParameters& parameters,
                                     const Progress& progress) {
  BlockwiseRun run = stereo_local_in_blocks(lf, views, parameters.local, progress);
  BlockPass pass;
  pass.step = "denoising";
  pass.unit = BlockUnit::Views;
  pass.bytes = [&lf](int) {
    constexpr double kMapsAndDenoised = 9 + 96;
    const double pixels = static_cast<double>(lf.height()) * lf.width();
    const double view = static_cast<double>(lf.byte_size()) / lf.grid().count();
    return kMapsAndDenoised * pixels + (lf.is_on_disk() ? view : 0);
  };
  pass.compute = [&lf, parameters](const MapBlock& block, const ReadBlock& read,
                                   const std::vector<double>&, const Progress& part) {
    FinishedBlock made{read(block)};
    made.finding = denoise(lf, parameters.denoising,
                           {DataWeight{}.minimum, static_cast<float>(parameters.map_noise)},
                           made.maps.field.disparity, made.maps.confidence, part);
    ViewStack<float>& maps = made.maps.field.disparity;
    fill_islands(parameters.islands, part.part(1, 1), maps.view(maps.first()));
    return made;
  };
  run.passes.push_back(std::move(pass));
  run.notes = [costs = std::exchange(run.provenance.notes, {})](const BlockProgress& end) {
    std::vector<std::string> notes = costs;
    notes.push_back(gap_note(end.finding));
    return notes;
  };
  return run;
}

}  // namespace episcope
