// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layers/line_fit.h"

#include "engine/disparity/common/box_mean.h"

#include <algorithm>
#include <array>
#include <vector>

namespace episcope {
namespace {

constexpr int kRadius = 2;
constexpr float kMinVariance = 1.0F / (255 * 255);  // below it nothing is seen
constexpr float kMostResidual = 3;                  // no fit on any side: any three colours

// Sums over windows of one quantity after the other.
class Windows {
 public:
  explicit Windows(int width) : column_(width), mean_(width) {}

  const float* mean(const Image<float>& image, int y) {
    window_mean_row(image, y, kRadius, column_.data(), mean_.data());
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

}  // namespace

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
                   [](float value) { return std::min(value, kMostResidual); });
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
      const float unrelated = 2 * std::max(variance[x], kMinVariance);
      coherence.at(y, x) = std::max(coherence.at(y, x), 1 - strictness * off[x] / unrelated);
    }
  }
}

}  // namespace episcope
