// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace episcope::io {

/// What to do with a file that may hold a light field in a form that is not read, as its suffix
/// tells: archives of files, raw pictures of Lytro cameras, tensors of learning programs. The end
/// of a sentence; empty for other files.
[[nodiscard]] std::string advice_on(const std::filesystem::path& path);

/// The same for a folder without a light field: of the first of such files in it, with its name,
/// and of GIF pictures. Throws std::filesystem::filesystem_error.
[[nodiscard]] std::string advice_on_folder(const std::filesystem::path& folder);

}  // namespace episcope::io
