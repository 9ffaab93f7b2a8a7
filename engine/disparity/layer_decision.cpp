// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layer_decision.h"

#include "engine/core/image.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/disparity/disparity_range.h"
#include "engine/disparity/kernels/shared_constants.h"
#include "engine/disparity/view_samples.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace episcope {
namespace {

// Sums over windows of one quantity after the other.
class Windows {
 public:
  explicit Windows(int width) : column_(width), mean_(width) {}

  const float* mean(const Image<float>& image, int y) {
    window_mean_row(image, y, kLineFitRadius, column_.data(), mean_.data());
    return mean_.data();
  }

 private:
  std::vector<float> column_, mean_;
};

// Samples of one channel, and the squares of all.
void read_row(const std::uint32_t* packed, int width, int y, std::array<Image<float>, 3>& samples,
              Image<float>& squares) {
  for (int c = 0; c < 3; ++c) {
    float* const to = samples[c].row(y);
    for (int x = 0; x < width; ++x) {
      to[x] = packed_sample(packed[x], c);
      squares.at(y, x) += to[x] * to[x];
    }
  }
}

// How well lines of one disparity explain a view, as a coherence: 1 − s·e/v, with e the mean over
// 5×5 pixels of the residuals of `disparity` (LineResiduals) and v what it would be if pixels had
// nothing to do with their lines, twice the variance of color there. Each of `coherence` that is
// less is raised to it. Beside a silhouette, where every window of a structure tensor holds two
// orientations, lines fit in half of the views at least; behind a transparent surface none fits.
// The strictness s makes up for views that are near, where other lines fit nearly as well.
// All images are `[y][x]` of one size; `residuals` has begun the view. Throws Cancelled.
void raise_by_line_fit(ImageView<const std::uint32_t> view, ImageView<const float> disparity,
                       float strictness, LineResiduals& residuals, Image<float>& coherence) {
  const int height = view.height, width = view.width;
  const Image<float> blank(height, width);
  std::array<Image<float>, 3> samples = {blank, blank, blank};
  Image<float> squares = blank, misfit = blank;
  for (int y = 0; y < height; ++y) {
    read_row(view.row(y), width, y, samples, squares);
    const float* const residual = residuals.row(y, disparity.row(y));
    std::transform(residual, residual + width, misfit.row(y),
                   [](float value) { return std::min(value, kMostFitResidual); });
  }
  Windows windows(width);
  std::vector<float> variance(width);
  for (int y = 0; y < height; ++y) {
    std::copy_n(windows.mean(squares, y), width, variance.data());
    for (const Image<float>& channel : samples) {
      const float* const mean = windows.mean(channel, y);
      for (int x = 0; x < width; ++x) variance[x] -= mean[x] * mean[x];
    }
    const float* const off = windows.mean(misfit, y);
    for (int x = 0; x < width; ++x) {
      const float unrelated = 2 * std::max(variance[x], kLeastFitVariance);
      coherence.at(y, x) = std::max(coherence.at(y, x), 1 - strictness * off[x] / unrelated);
    }
  }
}

// Of a layer, weighted by confidence; and those of it.
struct Moments {
  Image<float> weights, sums, squares;

  Moments(int height, int width)
      : weights(height, width), sums(height, width), squares(height, width) {}

  void fill_row(const float* layer, const std::uint8_t* confidence, int y) {
    for (int x = 0; x < weights.width(); ++x) {
      const float weight = confidence[x], d = layer[x];
      weights.at(y, x) = weight;
      sums.at(y, x) = weight * d;
      squares.at(y, x) = weight * d * d;
    }
  }
};

// Means over windows, row by row; one per thread.
class MeanRows {
 public:
  explicit MeanRows(const Moments& moments)
      : moments_(moments), columns_(moments.weights.width()), means_(3, moments.weights.width()) {}

  // Raises a row of `most` to the variance.
  void raise(int y, float* most) {
    window_mean_row(moments_.weights, y, kLayerVarianceRadius, columns_.data(), means_.row(0));
    window_mean_row(moments_.sums, y, kLayerVarianceRadius, columns_.data(), means_.row(1));
    window_mean_row(moments_.squares, y, kLayerVarianceRadius, columns_.data(), means_.row(2));
    const float *const weight = means_.row(0), *const sum = means_.row(1),
                       *const square = means_.row(2);
    for (int x = 0; x < means_.width(); ++x) {
      const float of = std::max(weight[x], kLeastLayerConfidence), mean = sum[x] / of;
      most[x] = std::max(most[x], square[x] / of - mean * mean);
    }
  }

 private:
  const Moments& moments_;
  std::vector<float> columns_;
  Image<float> means_;
};

// Raises `most` to the variance of a layer.
void add_variance(ImageView<const float> layer, ImageView<const std::uint8_t> confidence,
                  Image<float>& most, const Progress& progress) {
  Moments moments(layer.height, layer.width);
  parallel_for(layer.height, progress,
               [&](int y) { moments.fill_row(layer.row(y), confidence.row(y), y); });
  parallel_for_workers(layer.height, progress, [&] {
    return [&, means = MeanRows(moments)](int y) mutable { means.raise(y, most.row(y)); };
  });
}

// How far two layers are surfaces, in [0, 1]. Two orientations that are read into noise, or into
// silhouettes, leap from pixel to pixel; those of a transparent surface and of what is behind it
// do not. With s² the variance of disparity over the 5×5 px around a pixel, weighted by
// confidence, of the layer that varies more, and s₀ = 0.2 px: the mean of 1/(1 + s²/s₀²) over 9×9
// px, of which 0.3 is no surface and 0.5 is one. All images are `[y][x]` of one size; `confidence`
// in 1/255. Throws Cancelled. Evidence: tests/accuracy/tuning.md.
Image<float> layer_steadiness(ImageView<const float> near, ImageView<const float> far,
                              ImageView<const std::uint8_t> confidence, const Progress& progress) {
  Image<float> variance(near.height, near.width), steadiness(near.height, near.width);
  add_variance(near, confidence, variance, progress.part(0, 0.4));
  add_variance(far, confidence, variance, progress.part(0.4, 0.8));
  for (float& value : variance) value = 1 / (1 + value / (kLayerSpread * kLayerSpread));
  parallel_for_workers(near.height, progress.part(0.8, 1), [&] {
    return [&, columns = std::vector<float>(near.width)](int y) mutable {
      float* const row = steadiness.row(y);
      window_mean_row(variance, y, kSteadyRadius, columns.data(), row);
      for (int x = 0; x < near.width; ++x) {
        row[x] = std::clamp((row[x] - kUnsteadyMean) / (kSteadyMean - kUnsteadyMean), 0.0F, 1.0F);
      }
    };
  });
  return steadiness;
}

// Misfit of one orientation as a fraction of the misfits of one and of two: (1 − r)/(2 − r − c +
// 0.03), in [0, 1), with coherence r of one and confidence c of two. The constant decides for one
// where both fit almost perfectly.
[[nodiscard]] inline float single_misfit_share(float coherence, float confidence) {
  return (1 - coherence) / (2 - coherence - confidence + kLeastMisfit);
}

// The largest coherence within 2 px of each pixel, in x and y: the best of the windows that hold
// the pixel. Beside a silhouette one of them fits one orientation, in front of a transparent
// surface none does. `rows` is scratch; all are `[y][x]` of one size.
void spread_coherence(ImageView<const float> coherence, Image<float>& rows, Image<float>& spread) {
  const int height = coherence.height, width = coherence.width;
  for (int y = 0; y < height; ++y) {
    const float* from = coherence.row(y);
    float* to = rows.row(y);
    for (int x = 0; x < width; ++x) {
      const int begin = std::max(0, x - kCoherenceReach),
                end = std::min(width, x + kCoherenceReach + 1);
      to[x] = *std::max_element(from + begin, from + end);
    }
  }
  for (int y = 0; y < height; ++y) {
    float* to = spread.row(y);
    std::copy_n(rows.row(y), width, to);
    for (int j = std::max(0, y - kCoherenceReach); j < std::min(height, y + kCoherenceReach + 1);
         ++j) {
      const float* from = rows.row(j);
      for (int x = 0; x < width; ++x) to[x] = std::max(to[x], from[x]);
    }
  }
}

// Tiles looked at: one of so many.
constexpr int kTileStride = 3;
// Thresholds for an unambiguous pixel, and the fraction of such pixels that is not accidental.
constexpr float kSureShare = 0.35F;
constexpr float kSureConfidence = 0.6F;
constexpr double kEnoughLayers = 0.03;
// Share of those pixels that may lie beyond either end, and what is added to both ends.
constexpr double kLayerTail = 0.01;
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
  if (static_cast<double>(near.size()) < kEnoughLayers * looked_at) return single;
  return {std::min(single.min, std::max(-limit, quantile(far, kLayerTail) - kMargin)),
          std::max(single.max, std::min(limit, quantile(near, 1 - kLayerTail) + kMargin))};
}

namespace {}  // namespace

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
    score.data[i] = (fit * seen - kOneLayerWeight) / (fit + kOneLayerWeight);
    weight.data[i] = fit + kOneLayerWeight;
  }
}

}  // namespace episcope
