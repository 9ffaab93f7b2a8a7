// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/array/indices.h"
#include "engine/core/array/volume.h"

#include <cstdint>
#include <functional>

namespace episcope::io {

/// Probabilities of one view, `[y][label][x]`, 0 … 255 for 0 … 1.
using ViewProbabilities = std::function<VolumeView<const std::uint8_t>(ViewIndex)>;

/// As files hold them: `[y][x][label]` in [0, 1], into an image of that size.
void fill_samples(VolumeView<const std::uint8_t> probabilities, Image<float>& samples);

/// The reverse. What `fill_samples` wrote comes back bit by bit; other values are bounded to [0, 1]
/// and rounded, and what is no number becomes 0.
[[nodiscard]] Volume<std::uint8_t> bytes_of(const Image<float>& samples);

}  // namespace episcope::io
