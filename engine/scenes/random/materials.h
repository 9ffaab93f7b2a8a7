// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/scenes/random/plan.h"

namespace episcope::scenes {

/// A random texture of a surface where a pixel has size `pixel_units`: unless detail is smaller,
/// band-limited there, and fading where the surface slants away. Flat things keep their pattern in
/// their plane.
[[nodiscard]] Texture draw_texture(Draw draw, Finish finish, double pixel_units,
                                   const Detail& detail);

/// What is seen of a far background out of focus: large soft blobs.
[[nodiscard]] Texture draw_defocused_texture(Draw draw, double pixel_units, const Detail& detail);

/// A chequered floor: tiles in the plane of what is flat, about 30 px wide.
[[nodiscard]] Texture draw_chequered_texture(Draw draw, double pixel_units, const Detail& detail);

}  // namespace episcope::scenes
