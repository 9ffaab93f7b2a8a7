// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_rectangle.h"
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

/// Rows [first_row, end_row) of all views, which are the rows from 0 on of `pixels`. Throws
/// Cancelled.
[[nodiscard]] PackedViews pack_rows(const LightField& light_field, int first_row, int end_row,
                                    const Progress& progress);

/// The views of a rectangle and up to `reach` views beside each in its row and column; `pixels`
/// covers the rectangle around all of these, of which other views are black. Throws Cancelled.
[[nodiscard]] PackedViews pack_around(const LightField& light_field, const ViewRectangle& views,
                                      int reach, const Progress& progress);

/// How many views that are, for one row of `count` views in the middle of a large grid.
[[nodiscard]] inline int packed_around(int count, int reach) {
  return count + 2 * reach + 2 * reach * count;
}

/// Channel `c` of a packed pixel, in units of 1/1023.
[[nodiscard]] inline int packed_channel(std::uint32_t packed, int c) {
  return static_cast<int>(packed >> (kPackedBits * c)) & kPackedMost;
}

/// The same in [0, 1].
[[nodiscard]] inline float packed_sample(std::uint32_t packed, int c) {
  return static_cast<float>(packed_channel(packed, c)) / kPackedMost;
}

}  // namespace episcope
