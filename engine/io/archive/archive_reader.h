// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/open/open.h"

#include <filesystem>

namespace episcope::io {

/// Reads a light field of the 2013 archive: `file` is its lf.h5; labels.h5 and the
/// companions are looked for beside it. Throws IoError, Cancelled.
[[nodiscard]] Scene read_archive(const std::filesystem::path& file, const OpenOptions& options,
                                 const Progress& progress);

}  // namespace episcope::io
