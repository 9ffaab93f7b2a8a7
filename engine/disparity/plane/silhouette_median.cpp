// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane/silhouette_median.h"

#include "engine/core/array/image.h"
#include "engine/core/light_field/channel_weight.h"
#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace episcope {
namespace {

constexpr int kRadius = 4;
constexpr int kBand = 3;
constexpr float kJump_px = 0.2F;
// σ of colours, as a share of their spread, and at most, in three channels.
constexpr double kShareOfSpread = 0.25;
constexpr double kMostSigma = 0.08;
constexpr double kLeastSigma = 1e-3;
constexpr float kPlaceSigma_px = 1.7F;
constexpr int kSide = 2 * kRadius + 1;

// Marks what is within kBand of a jump, square by square.
Image<std::uint8_t> near_jumps(ImageView<const float> disparity) {
  const int height = disparity.height, width = disparity.width;
  Image<std::uint8_t> near(height, width);
  const auto mark = [&](int y, int x) {
    for (int row = std::max(0, y - kBand); row <= std::min(height - 1, y + kBand); ++row) {
      const int first = std::max(0, x - kBand), last = std::min(width - 1, x + kBand);
      std::fill(near.row(row) + first, near.row(row) + last + 1, std::uint8_t{1});
    }
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float d = disparity.at(y, x);
      const bool jumps = (x + 1 < width && std::abs(disparity.at(y, x + 1) - d) > kJump_px) ||
                         (y + 1 < height && std::abs(disparity.at(y + 1, x) - d) > kJump_px);
      if (jumps) mark(y, x);
    }
  }
  return near;
}

// exp(−r²/2ρ²) of the window, row by row.
std::array<float, kSide * kSide> place_weights() {
  std::array<float, kSide * kSide> weights{};
  for (int y = -kRadius; y <= kRadius; ++y) {
    for (int x = -kRadius; x <= kRadius; ++x) {
      weights[(y + kRadius) * kSide + x + kRadius] =
          std::exp(-static_cast<float>(y * y + x * x) / (2 * kPlaceSigma_px * kPlaceSigma_px));
    }
  }
  return weights;
}

// Root of the variances of the channels, summed.
double spread(const Image<float>& samples) {
  double variance = 0;
  const int channels = samples.channels();
  const double count = static_cast<double>(samples.size()) / channels;
  for (int c = 0; c < channels; ++c) {
    double sum = 0, squares = 0;
    const float* const end = samples.data() + samples.size();
    for (const float* at = samples.data() + c; at < end; at += channels) {
      sum += *at;
      squares += static_cast<double>(*at) * *at;
    }
    variance += std::max(0.0, squares / count - sum * sum / (count * count));
  }
  return std::sqrt(variance);
}

// A value of the window and its weight.
using Vote = std::pair<float, float>;

float weighted_median(std::array<Vote, kSide * kSide>& votes, int count) {
  std::sort(votes.begin(), votes.begin() + count);
  float sum = 0, before = 0;
  for (int i = 0; i < count; ++i) sum += votes[i].second;
  for (int i = 0; i < count; ++i) {
    before += votes[i].second;
    if (before >= sum / 2) return votes[i].first;
  }
  return votes[count - 1].first;
}

class Silhouettes {
 public:
  Silhouettes(const LightField& lf, ViewIndex view, ImageView<const float> disparity)
      : lf_(lf),
        view_(view),
        disparity_(disparity),
        samples_(lf.view_as_float(view)),
        places_(place_weights()) {
    const double channels = channel_weight(lf.channels());
    const double sigma = std::clamp(kShareOfSpread * std::sqrt(channels) * spread(samples_),
                                    kLeastSigma, kMostSigma);
    strength_ = static_cast<float>(-channels / (2 * sigma * sigma));
  }

  [[nodiscard]] float median(int y, int x) const {
    std::array<Vote, kSide * kSide> votes;
    int count = 0;
    const int last_row = std::min(lf_.height() - 1, y + kRadius);
    const int last_column = std::min(lf_.width() - 1, x + kRadius);
    for (int row = std::max(0, y - kRadius); row <= last_row; ++row) {
      for (int column = std::max(0, x - kRadius); column <= last_column; ++column) {
        if (!lf_.is_valid(view_, row, column)) continue;
        const int place = (row - y + kRadius) * kSide + column - x + kRadius;
        votes[count++] = {disparity_.at(row, column), places_[place] * likeness(y, x, row, column)};
      }
    }
    return weighted_median(votes, count);
  }

 private:
  [[nodiscard]] float likeness(int y, int x, int row, int column) const {
    const int channels = lf_.channels();
    const float* const one = samples_.row(y) + static_cast<std::ptrdiff_t>(x) * channels;
    const float* const other = samples_.row(row) + static_cast<std::ptrdiff_t>(column) * channels;
    float square = 0;
    for (int c = 0; c < channels; ++c) square += (one[c] - other[c]) * (one[c] - other[c]);
    return std::exp(strength_ * square);
  }

  const LightField& lf_;
  ViewIndex view_;
  ImageView<const float> disparity_;
  Image<float> samples_;
  std::array<float, kSide * kSide> places_;
  float strength_ = 0;  // −1/2σ²
};

}  // namespace

void place_silhouettes(const LightField& lf, ViewIndex view, const Progress& progress,
                       ImageView<float> disparity) {
  const Image<std::uint8_t> near = near_jumps(disparity);
  Image<float> before(disparity.height, disparity.width);
  for (int y = 0; y < disparity.height; ++y) {
    std::copy_n(disparity.row(y), disparity.width, before.row(y));
  }
  const Silhouettes silhouettes(lf, view, before);
  parallel_for(disparity.height, progress, [&](int y) {
    for (int x = 0; x < disparity.width; ++x) {
      if (near.at(y, x) == 0 || !lf.is_valid(view, y, x)) continue;
      disparity.at(y, x) = silhouettes.median(y, x);
    }
  });
}

}  // namespace episcope
