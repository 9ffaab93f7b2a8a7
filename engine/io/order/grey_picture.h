// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

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

}  // namespace episcope::io
