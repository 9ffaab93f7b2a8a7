// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

#include <cstdint>

namespace episcope::render {

/// A picture of 8-bit samples `[y][x][c]`, scaled down by the means of areas until its longer side
/// is `longest_px` (at least 1); as it is if it is no larger.
[[nodiscard]] Image<std::uint8_t> fitted(const Image<std::uint8_t>& picture, int longest_px);

}  // namespace episcope::render
