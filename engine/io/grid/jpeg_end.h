// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace episcope::io {

/// Throws IoError for a JPEG file that ends before its picture does, of which libraries make one
/// that is grey from there on. Nothing for other files.
void require_whole_jpeg(const std::filesystem::path& path);

}  // namespace episcope::io
