// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"

#include <array>

namespace episcope::io {

// Pictures of one channel for looking at the motion between views, `[y][x]`.

/// Cuts out the middle of a picture, at most `side` by `side` px.
[[nodiscard]] Image<float> middle_of(const Image<float>& picture, int side);

/// Averages squares of k by k px, with the smallest whole k that brings the larger side to at most
/// `side` px.
[[nodiscard]] Image<float> reduced(const Image<float>& picture, int side);

/// Smallest whole k that brings a side to at most `side` px.
[[nodiscard]] int reduction(int larger, int side);
/// Averages squares of k by k px.
[[nodiscard]] Image<float> reduced_by(const Image<float>& picture, int k);

/// Applies a Gaussian blur of 0.7 px, against noise and aliasing. The border is repeated.
[[nodiscard]] Image<float> smoothed(const Image<float>& picture);

/// Subtracts Gaussian blurs of 0.8 and 4 px and normalizes to mean 0 and variance 1. This removes
/// brightness, contrast and slow changes. All 0 for a picture without texture.
[[nodiscard]] Image<float> band_passed(const Image<float>& picture);

/// Grey view prepared for finding motion between views: band-passed, from fine to coarse. Scales:
/// the middle of 256×256 px, the whole reduced to 160 px, and the whole reduced to 40 px.
struct MotionPictures {
  static constexpr int kScales = 3;

  explicit MotionPictures(const Image<float>& grey);
  MotionPictures() = default;

  std::array<Image<float>, kScales> scales;
  double contrast = 0;  ///< Standard deviation of the reduced view, in its grey levels.
};

/// Correlation of two pictures of one scale, at the same places: 1 for equal pictures.
[[nodiscard]] double correlation(const Image<float>& a, const Image<float>& b);

}  // namespace episcope::io
