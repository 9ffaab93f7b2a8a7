// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/base/image_file.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// Decodes all pictures of labels in a file: each page of a TIFF, or the picture of another format
/// (`decode_label_picture`). Pages hold integers of 1 to 64 bits, with or without a sign, which are
/// clipped to int32, whole numbers in floats, indices of a palette of 8 bits, or colors of 8 or 16
/// bits. Throws IoError, also for fractions.
[[nodiscard]] std::vector<LabelPicture> decode_label_pages(const std::filesystem::path& path);

/// Decodes a black and white PNG in memory; not 0 = inside. `path` is for messages. Throws IoError.
[[nodiscard]] Image<std::uint8_t> decode_mask(const std::filesystem::path& path,
                                              const std::string& png);
/// Encodes one: 0 or 255 a pixel.
[[nodiscard]] std::vector<std::uint8_t> encode_mask(ImageView<const std::uint8_t> mask);

/// Writes labels as a PNG with a palette: a pixel is the id, `palette[id]` its color. `palette` has
/// 1 to 256 colors, more than the largest id. Atomic. Throws IoError.
void write_indexed_png(const std::filesystem::path& path, ImageView<const std::uint8_t> ids,
                       const std::vector<std::array<std::uint8_t, 3>>& palette);

}  // namespace episcope::io
