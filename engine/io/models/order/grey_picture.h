// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"

#include <array>

namespace episcope::io {

/// Pictures of one channel for looking at the motion between views, `[y][x]`.

/// The middle of a picture, of at most `side` by `side` px.
[[nodiscard]] Image<float> middle_of(const Image<float>& picture, int side);

/// Means over squares of k by k px, with the smallest whole k that brings the larger side to at
/// most `side` px.
[[nodiscard]] Image<float> reduced(const Image<float>& picture, int side);

/// The least whole k that brings a side to at most `side` px, and means over squares of such k.
[[nodiscard]] int reduction(int larger, int side);
[[nodiscard]] Image<float> reduced_by(const Image<float>& picture, int k);

/// A Gaussian blur of 0.7 px, against noise and aliasing; the border is repeated.
[[nodiscard]] Image<float> smoothed(const Image<float>& picture);

/// The difference of Gaussian blurs of 0.8 and 4 px, brought to mean 0 and variance 1: brightness,
/// contrast and slow changes over the picture are gone. All 0 for a picture without texture.
[[nodiscard]] Image<float> band_passed(const Image<float>& picture);

/// A grey view, prepared for finding motion between views: band-passed, from fine to coarse. The
/// middle of 256×256 px as it is, the whole reduced to 160 px, and reduced to 40 px.
struct MotionPictures {
  static constexpr int kScales = 3;

  explicit MotionPictures(const Image<float>& grey);
  MotionPictures() = default;

  std::array<Image<float>, kScales> scales;
  double contrast = 0;  ///< Standard deviation of the reduced view, in its grey levels.
};

/// Of two pictures of one scale, at the same places: 1 for the same picture.
[[nodiscard]] double correlation(const Image<float>& a, const Image<float>& b);

}  // namespace episcope::io
