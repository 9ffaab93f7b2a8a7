// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/stratified/pieces.h"

#include <algorithm>

namespace episcope::scenes {
namespace {

constexpr int kWall = 1;
constexpr int kDark = 2;
constexpr int kBright = 3;
constexpr int kBands = 4;
constexpr int kBars = 12;
constexpr float kContrasts[kBands] = {0.4F, 0.2F, 0.1F, 0.05F};

// Far beyond the image in px, so that every view is filled.
constexpr double kFar = 1e4;

// The row of the centre view, between pixels, where a band begins.
double band_top(const Stage& stage, int band) {
  if (band == 0) return -kFar;
  if (band == kBands) return kFar;
  return stage.height * band / kBands - 0.5;
}

class Weaver {
 public:
  Weaver(const Stage& stage, Draw draw) : stage_(stage), draw_(draw) {}

  // Adds one card in each band.
  void add(double left, double right, double disparity, int label, float brightness) {
    const double pixel = stage_.pixel(stage_.depth(disparity));
    for (int band = 0; band < kBands; ++band) {
      Primitive card = make_card(
          stage_, {left, band_top(stage_, band), right, band_top(stage_, band + 1), disparity});
      const std::array<float, 3> color{brightness, brightness * 0.97F, brightness * 0.92F};
      card.texture =
          model_.add(noise_texture(pixel, draw_.bits(), color, kContrasts[band] * contrast_));
      card.label = label;
      model_.primitives.push_back(card);
    }
  }

  Model take() { return std::move(model_); }

 private:
  const Stage& stage_;
  Draw draw_;
  float contrast_ = 0.8F;
  Model model_;
};

}  // namespace

Model stripes_model(const Stage& stage, Draw draw) {
  const double wall = draw.between(-0.8, -0.1);
  Weaver weaver(stage, draw.part(0));
  weaver.add(-kFar, kFar, wall, kWall, 0.66F);
  const double pitch = static_cast<double>(stage.width) / kBars;
  for (int i = 0; i < kBars; ++i) {
    const double share = (i + 1.0) / (kBars + 1);
    const double half = pitch * (0.05 + 0.25 * share);
    const double middle = (i + 0.5) * pitch;
    const double step = draw.between(0.3, 1.5);
    const bool is_dark = i % 2 == 0;
    weaver.add(middle - half, middle + half, wall + step, is_dark ? kDark : kBright,
               is_dark ? 0.25F : 0.72F);
  }
  Model model = weaver.take();
  if (draw.chance(0.5)) model.sensor = growing_noise(draw.part(1), 2, 6);
  return model;
}

Regions stripes_regions(const Stage& stage, CenterLabels labels) {
  const double lower = band_top(stage, kBands / 2);
  Regions regions;
  regions.emplace("low_texture", region_where(labels, [&](int y, int x) {
                    return y > lower && labels.at(y, x) == kWall;
                  }));
  regions.emplace("high_contrast", region_of(labels, kDark));
  regions.emplace("low_contrast", region_of(labels, kBright));
  return regions;
}

}  // namespace episcope::scenes
