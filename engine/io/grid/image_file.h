// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

#include <cstdint>
#include <filesystem>

namespace episcope::io {

/// Writes 8-bit grey, RGB or RGBA as PNG. Atomic. Throws IoError.
void write_png(const std::filesystem::path& path, ImageView<const std::uint8_t> image);

/// Writes 16-bit grey or RGB as PNG. Atomic. Throws IoError.
void write_png(const std::filesystem::path& path, ImageView<const std::uint16_t> image);

/// Writes 32-bit float TIFF, grey or RGB. Atomic. Throws IoError.
void write_tiff(const std::filesystem::path& path, ImageView<const float> image);

}  // namespace episcope::io
