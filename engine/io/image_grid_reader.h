// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/open.h"

#include <filesystem>

namespace episcope::io {

/// Reads a folder of equally sized images on a grid of views (formats.md §5). Throws IoError,
/// InvalidInput for a bad pattern, Cancelled.
[[nodiscard]] Scene read_image_grid(const std::filesystem::path& folder, const OpenOptions& options,
                                    const Progress& progress);

}  // namespace episcope::io
