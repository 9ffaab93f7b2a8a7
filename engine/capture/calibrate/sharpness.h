// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

#include <array>
#include <cstdint>
#include <span>

namespace episcope::capture {

/// How steep the edges around points are: the steepest change between neighbouring pixels within
/// `reach` px of a point, by the contrast there, averaged over the points: about 0.5 … 1 for sharp
/// photographs, 1/w where edges are w px wide. Of the changes across and down the lesser counts,
/// because a camera that moves blurs in one direction.
[[nodiscard]] double sharpness(ImageView<const std::uint8_t> grey,
                               std::span<const std::array<double, 2>> points, int reach);

}  // namespace episcope::capture
