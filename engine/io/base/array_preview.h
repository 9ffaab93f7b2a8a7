// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/io/base/array_input.h"
#include "engine/io/base/array_layout.h"

#include <cstdint>
#include <vector>

namespace episcope::io {

/// A view as an 8-bit RGB picture, for the first look; samples other than 8 and 16-bit ones are
/// scaled by the largest. Where all views of a pixel lie together, rows or columns of pixels are
/// read one by one, every 64th first, for at most 0.7 s; the others repeat what is beside them.
/// Throws IoError.
[[nodiscard]] Image<std::uint8_t> array_preview(const ArrayInput& array, const ArrayLayout& layout,
                                                ViewIndex view);

/// The middle of each of some views, of at most `side` pixels squared, in the
/// second channel (green) or the only one, of any range. Throws IoError.
[[nodiscard]] std::vector<Image<float>> array_windows(const ArrayInput& array,
                                                      const ArrayLayout& layout,
                                                      const std::vector<ViewIndex>& views,
                                                      int side);

}  // namespace episcope::io
