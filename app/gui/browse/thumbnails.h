// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

#include "engine/render/tone.h"

#include <cstdint>
#include <vector>

namespace episcope {

/// Small RGBA8 pictures of all views, row by row of the grid, each at most `width` by `height`
/// pixels and of the same aspect as the views: box means; brightened if a tone is given. Throws
/// Cancelled.
[[nodiscard]] std::vector<Image<std::uint8_t>> make_thumbnails(const LightField& light_field,
                                                               int width, int height,
                                                               const render::ToneTable* tone,
                                                               const Progress& progress);

}  // namespace episcope
