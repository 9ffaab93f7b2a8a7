// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

#include <cstdint>

namespace episcope::scenes {

/// Strokes such as a user would paint: for each label one along a row and one along a column of
/// its inside, clear of its outline. 0 = unpainted.
[[nodiscard]] Image<std::int32_t> scribble(ImageView<const std::int32_t> labels);

}  // namespace episcope::scenes
