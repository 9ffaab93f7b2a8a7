// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/load_views.h"
#include "engine/io/models/reader.h"

namespace episcope::io {

/// Reader of folders with equally sized images on a grid of views, or with such a folder inside
/// (`views_folder`).
[[nodiscard]] Reader image_grid_reader();

/// Returns the grid, and size and sample type from the header of the center view. If the first or
/// the last view has another size or cannot be decoded, predicts from headers what
/// `load_usable_views` will open. Throws IoError.
[[nodiscard]] SceneProbe probe_views(const ViewFiles& views);

}  // namespace episcope::io
