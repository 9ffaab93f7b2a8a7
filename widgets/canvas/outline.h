// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

#include <QLine>
#include <QPoint>

#include <cstdint>
#include <vector>

namespace episcope {

/// A line between pixels, from corner to corner.
using PixelEdges = std::vector<QLine>;

/// What surrounds the pixels of a mask that are not 0; its first pixel lies at `offset`.
[[nodiscard]] PixelEdges outline_of(ImageView<const std::uint8_t> mask, QPoint offset);

/// The lines between pixels of different labels, within the image: those with `label` on one side,
/// or all others. Coordinates as in `labels`.
enum class Boundaries { OfLabel, Others };
[[nodiscard]] PixelEdges boundaries_of(ImageView<const std::int32_t> labels, std::int32_t label,
                                       Boundaries which);

}  // namespace episcope
