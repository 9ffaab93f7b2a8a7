// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/grid/decode_image.h"

namespace episcope::io {

enum class Axis { X, Y };

/// Brightness along up to 400 rows (Axis::X) or columns (Axis::Y) spread over a picture: a line a
/// row, in units of the samples, the mean of the channels.
[[nodiscard]] Image<float> picture_lines(const AnyImage& picture, Axis axis);

}  // namespace episcope::io
