// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

#include <array>

namespace episcope::io {

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
