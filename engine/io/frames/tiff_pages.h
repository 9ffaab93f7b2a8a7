// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace episcope::io {

/// Pages of a TIFF file, counted by its directories, of which nothing else is read; 0 for files
/// that are none or are damaged, at most `most` + 1.
[[nodiscard]] int count_tiff_pages(const std::filesystem::path& path, int most);

/// What the program that wrote a TIFF file says about it: the text ImageDescription of the first
/// page, cut off after 64 KiB. Empty if there is none.
[[nodiscard]] std::string tiff_description(const std::filesystem::path& path);

}  // namespace episcope::io
