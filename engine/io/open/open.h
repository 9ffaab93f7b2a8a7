// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/open/open_options.h"

#include <filesystem>

namespace episcope::io {

/// Opens anything that holds a light field, with the first reader (`readers`) that recognises it.
/// Converts to the canonical convention, looks for truth, labels and companions beside it, and
/// reports what it found and how it was checked. Throws IoError with one sentence (what, where,
/// what to do), Cancelled on a stop request.
[[nodiscard]] Scene open_scene(const std::filesystem::path& path, const OpenOptions& options,
                               const Progress& progress);

}  // namespace episcope::io
