// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/io/base/image_header.h"
#include "engine/io/base/openexr_channels.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace episcope::io {

/// Decoded image in its stored sample type: 1 channel, or 3 in the order RGB. An alpha channel is
/// dropped.
using AnyImage = std::variant<Image<std::uint8_t>, Image<std::uint16_t>, Image<float>>;

/// Decodes PNG, JPEG, JPEG 2000, WebP, TIFF, BMP, PPM, OpenEXR and Radiance HDR and resolves
/// palettes. Samples of OpenEXR and Radiance are linear. TIFF files that state an orientation come
/// upright; Exif orientation (load_views.h) is ignored. Throws IoError.
[[nodiscard]] AnyImage decode_image(const std::filesystem::path& path,
                                    PicturePart part = PicturePart::Colors);

/// A decoded image, and which of its pixels hold something.
struct SeenImage {
  AnyImage image;
  /// 0 = alpha is 0, or an OpenEXR file stores nothing here, else 1; empty = 1 everywhere.
  Image<std::uint8_t> seen{};
};

/// Decodes as `decode_image` does, with levels from black, 0, to white, the largest of the type.
/// Throws IoError.
[[nodiscard]] SeenImage decode_seen(const std::filesystem::path& path);

/// Decodes the first `count` pages of a TIFF file. Throws IoError, also if there are fewer pages.
[[nodiscard]] std::vector<SeenImage> decode_pages(const std::filesystem::path& path, int count);

/// "512×512 px, 3 channels, 8 bit", for messages.
[[nodiscard]] std::string describe_image(const AnyImage& image);

/// Reads the header of a PNG, JPEG, TIFF, BMP or PNM. Decodes the image if its header is not
/// enough. Throws IoError.
[[nodiscard]] ImageHeader read_image_header(const std::filesystem::path& path);

/// Decodes the first channel of an integer image as numbers. Throws IoError for float images.
[[nodiscard]] Image<std::int32_t> decode_numbers(const std::filesystem::path& path);

/// A picture whose pixels stand for labels, as it is stored: numbers or colors.
struct LabelPicture {
  Image<std::int32_t>
      numbers;  ///< Gray levels, or indices of `palette`; empty for a color picture.
  std::vector<std::array<std::uint8_t, 3>> palette;  ///< RGB; empty unless the picture has one.
  Image<std::uint8_t> colors;                        ///< RGB; empty for numbers.
  Image<std::uint8_t> alpha;                         ///< 255 = opaque; empty = everywhere.

  [[nodiscard]] int height() const { return std::max(numbers.height(), colors.height()); }
  [[nodiscard]] int width() const { return std::max(numbers.width(), colors.width()); }
};

/// Decodes a picture of labels. Indices of a PNG's palette stay as they are, and so do gray levels
/// of fewer than 8 bits; colors of 16 bits become 8. Throws IoError, also for float images.
[[nodiscard]] LabelPicture decode_label_picture(const std::filesystem::path& path);

/// Whether a file begins as a PNG does.
[[nodiscard]] bool has_png_signature(const std::filesystem::path& path);

/// Decodes a PNG row by row. Fewer than 8 bits become 8 bits, a palette becomes RGB. Throws IoError
/// for a file that is truncated, has a chunk with a wrong checksum, or claims more pixels than its
/// bytes can hold. Memory stays below 1100 times the size of the file.
[[nodiscard]] AnyImage decode_png(const std::filesystem::path& path);

/// Decodes at most the first `rows` rows and ignores what follows. Decodes all rows of an
/// interlaced picture.
[[nodiscard]] AnyImage decode_png_top(const std::filesystem::path& path, int rows);

/// Writes 8-bit grey, RGB or RGBA as PNG. Atomic. Throws IoError.
void write_png(const std::filesystem::path& path, ImageView<const std::uint8_t> image);

/// Writes a picture for people, of a map, an error, labels, as `write_png` does, with a text that
/// says that Episcope made it: such pictures are no views of a light field. Atomic. Throws IoError.
void write_picture(const std::filesystem::path& path, ImageView<const std::uint8_t> image);

/// Whether a file is a PNG that `write_picture` wrote. False for a file that cannot be read.
[[nodiscard]] bool is_own_picture(const std::filesystem::path& path);

/// Writes 16-bit grey or RGB as PNG. Atomic. Throws IoError.
void write_png(const std::filesystem::path& path, ImageView<const std::uint16_t> image);

/// Writes 32-bit float TIFF, grey or RGB. Atomic. Throws IoError.
void write_tiff(const std::filesystem::path& path, ImageView<const float> image);

}  // namespace episcope::io
