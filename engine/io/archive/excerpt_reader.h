// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/open/open.h"

#include <filesystem>

namespace episcope::io {

/// Whether a folder holds an excerpt of an archive scene: `lf/` with images on a grid,
/// `attributes.dat` and `depth.bin`.
[[nodiscard]] bool is_excerpt_folder(const std::filesystem::path& folder);

/// Reads an excerpt of an archive scene: views `lf/<row>_<col>.png`; `depth.bin`, float32 little
/// endian `[y][x]` of the centre view; `attributes.dat` with lines "value //name" whose dH and
/// shift are per step of the grid in `lf/`; `mask.png`, 0 = no depth there. Throws IoError,
/// Cancelled.
[[nodiscard]] Scene read_excerpt(const std::filesystem::path& folder, const OpenOptions& options,
                                 const Progress& progress);

}  // namespace episcope::io
