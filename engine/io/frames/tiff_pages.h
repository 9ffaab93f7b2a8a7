// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace episcope::io {

/// Pages of a TIFF file, counted by its directories, of which nothing else is read; 0 for files
/// that are none or are damaged, at most `most` + 1.
[[nodiscard]] int count_tiff_pages(const std::filesystem::path& path, int most);

}  // namespace episcope::io
