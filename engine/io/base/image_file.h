// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/io/base/image_header.h"
#include "engine/io/base/openexr_channels.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace episcope::io {

/// A decoded image in its stored sample type: 1 channel, or 3 in the order RGB. An alpha channel is
/// dropped.
using AnyImage = std::variant<Image<std::uint8_t>, Image<std::uint16_t>, Image<float>>;

/// Decodes PNG, JPEG, JPEG 2000, WebP, TIFF, BMP, PPM, OpenEXR and Radiance HDR; a palette is
/// resolved. The samples of the last two are linear. TIFF files that state an orientation come
/// upright; Exif orientation (image_orientation.h) is ignored. Throws IoError.
[[nodiscard]] AnyImage decode_image(const std::filesystem::path& path,
                                    PicturePart part = PicturePart::Colours);

/// The first `count` pages of a TIFF file, likewise. Throws IoError, also if there are less.
[[nodiscard]] std::vector<AnyImage> decode_pages(const std::filesystem::path& path, int count);

/// Whether the suffix is one that `decode_image` reads.
[[nodiscard]] bool is_image_name(const std::filesystem::path& path);

/// "512×512 px, 3 channels, 8 bit", for messages.
[[nodiscard]] std::string describe_image(const AnyImage& image);

/// Reads the header of a PNG, JPEG, TIFF, BMP or PNM; where that does not tell, the image is
/// decoded. Throws IoError.
[[nodiscard]] ImageHeader read_image_header(const std::filesystem::path& path);

/// First channel of an integer image, as numbers. Throws IoError for float images.
[[nodiscard]] Image<std::int32_t> decode_numbers(const std::filesystem::path& path);

/// Whether a file begins as a PNG does.
[[nodiscard]] bool has_png_signature(const std::filesystem::path& path);

/// Decodes a PNG row by row, of 8 or 16 bit; less becomes 8 bit, a palette RGB. Throws IoError for
/// a file that is truncated, has a chunk whose checksum is wrong, or claims more pixels than its
/// bytes can hold; memory stays below 1100 times the size of the file.
[[nodiscard]] AnyImage decode_png(const std::filesystem::path& path);

/// Likewise, only the first `rows` rows at most; what follows them is not looked at. All rows of an
/// interlaced picture.
[[nodiscard]] AnyImage decode_png_top(const std::filesystem::path& path, int rows);

/// Whether a file begins as a Radiance picture (.hdr) does.
[[nodiscard]] bool has_radiance_signature(const std::filesystem::path& path);

/// Decodes a Radiance picture, rows from top to bottom, four bytes a pixel (RGB with a common
/// exponent) as they are or in runs, to three linear channels. Throws IoError for other kinds and
/// for a file that is damaged. By ourselves, because OpenCV 4.6 leaves a file open with each that
/// is damaged. Source: Ward, "Real Pixels", Graphics Gems II, 1991.
[[nodiscard]] Image<float> decode_radiance(const std::filesystem::path& path);

/// Throws IoError for a JPEG file that ends before its picture does, of which libraries make one
/// that is grey from there on. Nothing for other files.
void require_whole_jpeg(const std::filesystem::path& path);

/// Writes 8-bit grey, RGB or RGBA as PNG. Atomic. Throws IoError.
void write_png(const std::filesystem::path& path, ImageView<const std::uint8_t> image);

/// Writes 16-bit grey or RGB as PNG. Atomic. Throws IoError.
void write_png(const std::filesystem::path& path, ImageView<const std::uint16_t> image);

/// Writes 32-bit float TIFF, grey or RGB. Atomic. Throws IoError.
void write_tiff(const std::filesystem::path& path, ImageView<const float> image);

}  // namespace episcope::io
