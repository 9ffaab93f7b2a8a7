// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layers/layer_steadiness.h"

#include "engine/core/parallel/parallel.h"
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
    window_mean_row(moments_.weights, y, kRadius, columns_.data(), means_.row(0));
    window_mean_row(moments_.sums, y, kRadius, columns_.data(), means_.row(1));
    window_mean_row(moments_.squares, y, kRadius, columns_.data(), means_.row(2));
    const float *const weight = means_.row(0), *const sum = means_.row(1),
                       *const square = means_.row(2);
    for (int x = 0; x < means_.width(); ++x) {
      const float of = std::max(weight[x], kLeastWeight), mean = sum[x] / of;
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

}  // namespace

Image<float> layer_steadiness(ImageView<const float> near, ImageView<const float> far,
                              ImageView<const std::uint8_t> confidence, const Progress& progress) {
  Image<float> variance(near.height, near.width), steadiness(near.height, near.width);
  add_variance(near, confidence, variance, progress.part(0, 0.4));
  add_variance(far, confidence, variance, progress.part(0.4, 0.8));
  for (float& value : variance) value = 1 / (1 + value / (kSpread * kSpread));
  parallel_for_workers(near.height, progress.part(0.8, 1), [&] {
    return [&, columns = std::vector<float>(near.width)](int y) mutable {
      float* const row = steadiness.row(y);
      window_mean_row(variance, y, kReach, columns.data(), row);
      for (int x = 0; x < near.width; ++x) {
        row[x] = std::clamp((row[x] - kNoSurface) / (kSurface - kNoSurface), 0.0F, 1.0F);
      }
    };
  });
  return steadiness;
}

}  // namespace episcope
