// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"

#include <filesystem>

namespace episcope::io {

/// Reads a map as text, a line for each row of pixels, top to bottom: numbers with a decimal point,
/// between commas, semicolons, tabs or spaces. Empty cells and words such as nan are NaN; empty
/// lines and lines that begin with # are skipped. Throws IoError that names the line.
[[nodiscard]] Image<float> read_csv_map(const std::filesystem::path& path);

/// Writes such a map with commas; numbers read back exactly, NaN and infinite values as nan.
/// Atomic. Throws IoError.
void write_csv_map(const std::filesystem::path& path, ImageView<const float> map);

}  // namespace episcope::io
