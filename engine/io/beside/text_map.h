// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

#include <filesystem>

namespace episcope::io {

/// Whether a file of this suffix (.txt, .csv, .dat) begins with a row of eight numbers or more, as
/// matrices do that NumPy, MATLAB and spreadsheets write. Reads the beginning of the file only.
[[nodiscard]] bool is_text_map(const std::filesystem::path& path);
/// By its suffix alone.
[[nodiscard]] bool has_text_suffix(const std::filesystem::path& path);

/// A row of pixels in each line, its numbers separated by blanks, commas or semicolons; empty lines
/// and those that begin with # or % are left out; nan and inf are numbers. Throws IoError for
/// lines of different lengths, for anything else, and for more than 400 MB.
[[nodiscard]] Image<float> read_text_map(const std::filesystem::path& path);

}  // namespace episcope::io
