// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

namespace episcope::io {

/// Makes a folder and those above it, unless it is there. Throws IoError: "the folder cannot be
/// created (why)" followed by `advice`, which begins with its own punctuation.
void make_folder(const std::filesystem::path& folder,
                 std::string_view advice = "; choose another one");

}  // namespace episcope::io
