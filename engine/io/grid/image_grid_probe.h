// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/grid/load_views.h"
#include "engine/io/open/scene_probe.h"

#include <filesystem>

namespace episcope::io {

/// Grid, and size and samples by the header of the centre view. Where the first or the last view
/// has another size, or one cannot be decoded, what `load_usable_views` will open as far as headers
/// tell it. Throws IoError.
[[nodiscard]] SceneProbe probe_views(const ViewFiles& views);

/// What names and headers of a folder of images tell, and names of the maps beside them. Throws
/// IoError, InvalidInput as reading does.
[[nodiscard]] SceneProbe probe_image_grid(const std::filesystem::path& folder,
                                          const OpenOptions& options);

}  // namespace episcope::io
