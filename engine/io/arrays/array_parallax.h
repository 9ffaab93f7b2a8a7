// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/arrays/array_input.h"
#include "engine/io/arrays/array_layout.h"
#include "engine/io/order/parallax_axis.h"

namespace episcope::io {

/// What moves between the centre and its neighbours along each axis of views.
struct Parallax {
  AxisEvidence along_u;
  AxisEvidence along_v;
};

/// Reads three views at most, and of them the middle. Throws IoError.
[[nodiscard]] Parallax measure_parallax(const ArrayInput& array, const ArrayLayout& layout);

/// Of two axes of a layout one is perhaps that of channels: whether there is motion along the other
/// one, of views, and clearly less that motion explains along this one.
[[nodiscard]] bool are_rather_channels(const AxisEvidence& of_channels,
                                       const AxisEvidence& of_views);

}  // namespace episcope::io
