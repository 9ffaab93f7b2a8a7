// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layers/layer_steadiness.h"

#include "engine/disparity/common/box_mean.h"

#include <algorithm>
#include <vector>

namespace episcope {
namespace {

constexpr int kRadius = 2;
constexpr float kSpread = 0.2F;  // s₀, px
constexpr float kLeastWeight = 1e-6F;
// The mean of 1/(1 + s²/s₀²) over (2·kReach + 1)² px from which on layers are surfaces, and below
// which they are not.
constexpr int kReach = 4;
constexpr float kSurface = 0.5F, kNoSurface = 0.3F;

// Means over windows of what is added to it pixel by pixel.
class Moment {
 public:
  Moment(int height, int width) : values_(height, width), columns_(width), mean_(width) {}
  float& at(int y, int x) { return values_.at(y, x); }
  const float* row(int y) {
    window_mean_row(values_, y, kRadius, columns_.data(), mean_.data());
    return mean_.data();
  }

 private:
  Image<float> values_;
  std::vector<float> columns_, mean_;
};

// Raises `most` to the variance of a layer.
void add_variance(ImageView<const float> layer, ImageView<const std::uint8_t> confidence,
                  Image<float>& most) {
  Moment weights(layer.height, layer.width), sums = weights, squares = weights;
  for (int y = 0; y < layer.height; ++y) {
    for (int x = 0; x < layer.width; ++x) {
      const float weight = confidence.at(y, x), d = layer.at(y, x);
      weights.at(y, x) = weight;
      sums.at(y, x) = weight * d;
      squares.at(y, x) = weight * d * d;
    }
  }
  for (int y = 0; y < layer.height; ++y) {
    const float *const weight = weights.row(y), *const sum = sums.row(y),
                       *const square = squares.row(y);
    float* const out = most.row(y);
    for (int x = 0; x < layer.width; ++x) {
      const float of = std::max(weight[x], kLeastWeight), mean = sum[x] / of;
      out[x] = std::max(out[x], square[x] / of - mean * mean);
    }
  }
}

}  // namespace

Image<float> layer_steadiness(ImageView<const float> near, ImageView<const float> far,
                              ImageView<const std::uint8_t> confidence) {
  Image<float> variance(near.height, near.width), steadiness(near.height, near.width);
  add_variance(near, confidence, variance);
  add_variance(far, confidence, variance);
  for (float& value : variance) value = 1 / (1 + value / (kSpread * kSpread));
  std::vector<float> columns(near.width);
  for (int y = 0; y < near.height; ++y) {
    float* const row = steadiness.row(y);
    window_mean_row(variance, y, kReach, columns.data(), row);
    for (int x = 0; x < near.width; ++x) {
      row[x] = std::clamp((row[x] - kNoSurface) / (kSurface - kNoSurface), 0.0F, 1.0F);
    }
  }
  return steadiness;
}

}  // namespace episcope
