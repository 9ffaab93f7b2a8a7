// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace episcope::io {

/// A decoded image in its stored sample type: 1 channel, or 3 in the order RGB. An alpha channel is
/// dropped.
using AnyImage = std::variant<Image<std::uint8_t>, Image<std::uint16_t>, Image<float>>;

/// What of an OpenEXR file is wanted, which may hold both (exr_channels.h).
enum class PicturePart { Colours, Depth };

/// Decodes PNG, JPEG, JPEG 2000, WebP, TIFF, BMP, PPM, OpenEXR and Radiance HDR; a palette is
/// resolved. The samples of the last two are linear. TIFF files that state an orientation come
/// upright; Exif orientation (exif_orientation.h) is ignored. Throws IoError.
[[nodiscard]] AnyImage decode_image(const std::filesystem::path& path,
                                    PicturePart part = PicturePart::Colours);

/// The first `count` pages of a TIFF file, likewise. Throws IoError, also if there are less.
[[nodiscard]] std::vector<AnyImage> decode_pages(const std::filesystem::path& path, int count);

/// Whether the suffix is one that `decode_image` reads.
[[nodiscard]] bool is_image_name(const std::filesystem::path& path);

/// "512×512 px, 3 channels, 8 bit", for messages.
[[nodiscard]] std::string describe_image(const AnyImage& image);

/// First channel of an integer image, as numbers. Throws IoError for float images.
[[nodiscard]] Image<std::int32_t> decode_numbers(const std::filesystem::path& path);

}  // namespace episcope::io
