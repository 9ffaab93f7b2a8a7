// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

#include <cstdint>

namespace episcope {

/// What the pixels of a mask are.
struct MaskValues {
  std::uint8_t of_label = 255;
  std::uint8_t of_others = 0;
};

/// Where a picture of labels `[y][x]` has one of them.
[[nodiscard]] Image<std::uint8_t> label_mask(ImageView<const std::int32_t> labels,
                                             std::int32_t label, MaskValues values = {});

}  // namespace episcope
