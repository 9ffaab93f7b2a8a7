// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layers/layer_range.h"

#include "engine/core/array/quantile.h"
#include "engine/disparity/common/disparity_range.h"
#include "engine/disparity/layers/double_layers.h"
#include "engine/disparity/layers/layer_decision.h"
#include "engine/disparity/layers/layer_steadiness.h"

#include <algorithm>
#include <vector>

namespace episcope {
namespace {

// Tiles looked at: one of so many.
constexpr int kTileStride = 3;
// Thresholds for an unambiguous pixel, and the fraction of such pixels that is not accidental.
constexpr float kSureShare = 0.35F;
constexpr float kSureConfidence = 0.6F;
constexpr double kEnough = 0.03;
// Share of those pixels that may lie beyond either end, and what is added to both ends.
constexpr double kTail = 0.01;
constexpr double kMargin = 0.1;

// Farther apart than orientations that are not there come out.
constexpr double kMinDistance = 0.3;

}  // namespace

Interval search_layer_range(const LightField& lf, const EpiLParameters& parameters,
                            const TensorScales& double_scales, const Progress& progress,
                            Device device, double limit) {
  require_double_grid(lf);
  const Interval single = search_range(lf, parameters.range, progress.part(0, 0.3));
  if (range_source(lf, parameters.range) != RangeSource::Found) return single;
  EpiLParameters coarse = parameters;
  coarse.range = Interval{-limit, limit};
  coarse.shear_step = 1;
  const Estimate estimate =
      estimate_orientations(lf, coarse, ViewSelection::Center, progress.part(0.3, 0.6), device);
  const MapBlock center_view{{lf.center(), {1, 1}}, 0, lf.height()};
  const DoubleLayers layers =
      measure_double_layers(lf, double_scales, {{-limit, limit}, kMinDistance, kTileStride},
                            center_view, progress.part(0.6, 0.97), device);
  Image<float> rows(lf.height(), lf.width()), coherence(lf.height(), lf.width());
  spread_coherence(estimate.confidence.view(lf.center()), rows, coherence);
  const Image<float> steadiness =
      layer_steadiness(layers.near.view(lf.center()), layers.far.view(lf.center()),
                       layers.confidence.view(lf.center()), progress.part(0.97, 1));
  std::vector<float> near, far;
  for (std::size_t i = 0; i < layers.near.size(); ++i) {
    const float confidence =
        static_cast<float>(layers.confidence.data()[i]) / 255 * steadiness.data()[i];
    if (confidence < kSureConfidence) continue;
    if (single_misfit_share(coherence.data()[i], confidence) < kSureShare) continue;
    near.push_back(layers.near.data()[i]);
    far.push_back(layers.far.data()[i]);
  }
  const double looked_at = static_cast<double>(coherence.size()) / kTileStride;
  if (static_cast<double>(near.size()) < kEnough * looked_at) return single;
  return {std::min(single.min, std::max(-limit, quantile(far, kTail) - kMargin)),
          std::max(single.max, std::min(limit, quantile(near, 1 - kTail) + kMargin))};
}

}  // namespace episcope
