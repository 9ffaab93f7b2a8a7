// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/depth/view_surface.h"

namespace episcope::capture {

/// Discontinuities that run between pixels: where the planes of two neighbours that are Seen differ
/// by `jump` in 1/Z half way between them, both become Unsure. Slopes, however steep, do not.
/// Throws Cancelled.
void mark_cracks(ViewSurface& view, double jump, const Progress& progress);

}  // namespace episcope::capture
