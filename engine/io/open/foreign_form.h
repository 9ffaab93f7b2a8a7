// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace episcope::io {

/// What to do with a file that may hold a light field in a form that is not read, as its suffix
/// tells: archives of files, raw pictures of Lytro cameras, tensors of learning programs. The end
/// of a sentence; empty for other files.
[[nodiscard]] std::string advice_on(const std::filesystem::path& path);

}  // namespace episcope::io
