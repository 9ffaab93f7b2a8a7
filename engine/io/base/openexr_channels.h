// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace episcope::io {

/// Part of an OpenEXR file to decode, which may hold both.
enum class PicturePart { Colors, Depth };

/// Pixels of an OpenEXR file, in the coordinates of its picture.
struct ExrWindow {
  std::int64_t left = 0, top = 0, width = 0, height = 0;
  friend bool operator==(const ExrWindow&, const ExrWindow&) = default;
};

/// What an OpenEXR file needs besides its decoder.
struct ExrPicture {
  /// The bytes of the file with channels by names that OpenCV knows; empty if it can be decoded as
  /// it is, has several parts, or is packed by DWA, which depends on names.
  std::vector<std::uint8_t> renamed;
  ExrWindow data;     ///< Pixels that are stored,
  ExrWindow display;  ///< and the picture in which they lie.
};

/// Reads the windows and renames channels that OpenCV does not know: layers of a render
/// (`View Layer.Combined.R`) and depth (`Z`, `V`, `View Layer.Depth.Z`). Of several layers the
/// combined one counts, else the first with red, green and blue. Of a file without colors the depth
/// counts, or the only channel. `Depth` finds depth also beside colors. Returns nothing for other
/// files. Linear in the bytes. Throws IoError if a header claims more than the file holds.
[[nodiscard]] std::optional<ExrPicture> read_exr(const std::filesystem::path& path,
                                                 PicturePart part);

}  // namespace episcope::io
