// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layers/layer_score.h"

#include "engine/disparity/layers/layer_decision.h"
#include "engine/disparity/layers/layer_steadiness.h"
#include "engine/disparity/layers/line_fit.h"

#include <algorithm>

namespace episcope {
namespace {

// Coherence and confidence that noise alone reaches (measured), and the weight of one layer where
// nothing else is seen.
constexpr float kNoiseFit = 0.3F;
constexpr float kOneLayer = 0.02F;

}  // namespace

float line_strictness(GridShape grid) {
  const int reach = std::clamp(std::max(grid.u, grid.v) / 2, 1, kMaxArmViews);
  return 3.0F * kMaxArmViews * kMaxArmViews / static_cast<float>(reach * reach);
}

LayerScore::LayerScore(const PackedViews& packed, GridShape grid, double decision)
    : packed_(packed),
      decision_(static_cast<float>(decision)),
      strictness_(line_strictness(grid)),
      residuals_(packed),
      rows_(packed.pixels.height(), packed.pixels.width()),
      coherence_(packed.pixels.height(), packed.pixels.width()) {}

void LayerScore::judge(ViewIndex view, const Maps& maps, ImageView<float> score,
                       ImageView<float> weight) {
  spread_coherence(maps.fit, rows_, coherence_);
  residuals_.begin(view);
  raise_by_line_fit(packed_.pixels.view(view), maps.single, strictness_, residuals_, coherence_);
  const Image<float> steadiness =
      layer_steadiness(maps.near, maps.far, maps.confidence, Progress(1));
  for (std::size_t i = 0; i < coherence_.size(); ++i) {
    const float r = coherence_.data()[i];
    const float c = static_cast<float>(maps.confidence.data[i]) / 255;
    const float share = single_misfit_share(r, c);
    const float doubles =
        share > decision_ ? (share - decision_) / (1 - decision_) : share / decision_ - 1;
    // What is no surface speaks for one layer.
    const float seen = steadiness.data()[i] * (doubles + 1) - 1;
    const float fit = std::max((std::max(r, c) - kNoiseFit) / (1 - kNoiseFit), 0.0F);
    score.data[i] = (fit * seen - kOneLayer) / (fit + kOneLayer);
    weight.data[i] = fit + kOneLayer;
  }
}

}  // namespace episcope
