// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/models/open_options.h"

#include <filesystem>
#include <string>

namespace episcope::io {

/// Opens anything that holds a light field, with the first reader (`readers`) that recognises it.
/// Converts to the canonical convention, looks for truth, labels and companions beside it, and
/// reports what it found and how it was checked. Throws IoError with one sentence (what, where,
/// what to do), Cancelled on a stop request.
[[nodiscard]] Scene open_scene(const std::filesystem::path& path, const OpenOptions& options,
                               const Progress& progress);

/// What to do with a file that may hold a light field in a form that is not read, as its suffix
/// tells: archives of files, raw pictures of Lytro cameras, tensors of learning programs. The end
/// of a sentence; empty for other files.
[[nodiscard]] std::string advice_on(const std::filesystem::path& path);

/// The same for a folder without a light field: of the first of such files in it, with its name,
/// and of GIF pictures. Throws std::filesystem::filesystem_error.
[[nodiscard]] std::string advice_on_folder(const std::filesystem::path& folder);

}  // namespace episcope::io
