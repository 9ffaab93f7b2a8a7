// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/io/base/array_input.h"
#include "engine/io/base/array_layout.h"

#include <cstdint>
#include <vector>

namespace episcope::io {

/// Reads a view as an 8-bit RGB picture for a first look. Samples other than 8 and 16-bit ones are
/// scaled by the largest. Where all views of a pixel lie together, rows or columns are read for at
/// most 0.7 s, every 64th first; the others repeat their neighbors. Throws IoError.
[[nodiscard]] Image<std::uint8_t> array_preview(const ArrayInput& array, const ArrayLayout& layout,
                                                ViewIndex view);

/// Reads a window of at most `side`×`side` pixels from the middle of each view: the green or only
/// channel, of any range. Throws IoError.
[[nodiscard]] std::vector<Image<float>> array_windows(const ArrayInput& array,
                                                      const ArrayLayout& layout,
                                                      const std::vector<ViewIndex>& views,
                                                      int side);

}  // namespace episcope::io
