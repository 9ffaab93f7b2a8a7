// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/models/open_options.h"

#include <filesystem>
#include <string>

namespace episcope::io {

/// Opens any light field, with the first reader (`readers`) that recognizes it. Converts it to the
/// canonical convention, finds truth, labels and companions beside it, and reports what was found
/// and how it was checked. Throws IoError with one sentence (what, where, what to do). Throws
/// Cancelled.
[[nodiscard]] Scene open_scene(const std::filesystem::path& path, const OpenOptions& options,
                               const Progress& progress);

/// Advice on a file whose content is of no form that is read (foreign_content.h), or whose suffix
/// names a form that its bytes do not tell. The end of a sentence; empty for other files.
[[nodiscard]] std::string advice_on(const std::filesystem::path& path);

/// Advice on a folder without a light field, by its first file of an unsupported format or GIF
/// picture, with its name. Empty if there is none. Throws std::filesystem::filesystem_error.
[[nodiscard]] std::string advice_on_folder(const std::filesystem::path& folder);

}  // namespace episcope::io
