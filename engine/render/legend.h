// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/render/shade.h"

#include <cstdint>
#include <string>

namespace episcope::render {

/// An RGBA8 picture, on white, with the scale of its colors to its right: a bar from the largest
/// value on top to the smallest, five values at equal distances, the unit below them, and the color
/// of pixels without a value, marked n/a. Text grows with the picture; small pictures get room for
/// the bar. `unit`: "px", or empty.
[[nodiscard]] Image<std::uint8_t> with_legend(const Image<std::uint8_t>& picture,
                                              const Shading& shading, const std::string& unit);

}  // namespace episcope::render
