// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/disparity/common/packed_pixel.h"

#include <cstdint>

namespace episcope {

/// All views with each pixel packed into one word: three channels of 10 bits, the first lowest,
/// each round(1023·s) of a sample s in [0, 1]; grey three times. Of a pixel that is not valid, a
/// bit above them and nothing else is set. A single gather then fetches a pixel whatever its type.
/// 4 bytes per ray.
struct PackedViews {
  ViewStack<std::uint32_t> pixels;
  bool has_invalid = false;  ///< Whether any may be not valid.
};

/// Throws Cancelled.
[[nodiscard]] PackedViews pack_views(const LightField& light_field, const Progress& progress);

/// Channel `c` of a packed pixel, in units of 1/1023.
[[nodiscard]] inline int packed_channel(std::uint32_t packed, int c) {
  return static_cast<int>(packed >> (kPackedBits * c)) & kPackedMost;
}

/// The same in [0, 1].
[[nodiscard]] inline float packed_sample(std::uint32_t packed, int c) {
  return static_cast<float>(packed_channel(packed, c)) / kPackedMost;
}

}  // namespace episcope
