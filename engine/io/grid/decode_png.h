// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/grid/decode_image.h"

#include <filesystem>

namespace episcope::io {

/// Whether a file begins as a PNG does.
[[nodiscard]] bool has_png_signature(const std::filesystem::path& path);

/// Decodes a PNG row by row, of 8 or 16 bit; less becomes 8 bit, a palette RGB. Throws IoError for
/// a file that is truncated, has a chunk whose checksum is wrong, or claims more pixels than its
/// bytes can hold; memory stays below 1100 times the size of the file.
[[nodiscard]] AnyImage decode_png(const std::filesystem::path& path);

/// Likewise, only the first `rows` rows at most; what follows them is not looked at. All rows of an
/// interlaced picture.
[[nodiscard]] AnyImage decode_png_top(const std::filesystem::path& path, int rows);

}  // namespace episcope::io
