// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace episcope::io {

/// Part of an OpenEXR file to decode, which may hold both.
enum class PicturePart { Colors, Depth };

/// Renames channels that OpenCV does not know: layers of a render (`View Layer.Combined.R`) and
/// depth (`Z`, `V`, `View Layer.Depth.Z`). Returns the bytes of the file with names by which OpenCV
/// decodes the wanted part. Of several layers the combined one counts, else the first with red,
/// green and blue. Of a file without colors the depth counts, or the only channel. `Depth` finds
/// depth also beside colors. Returns nothing if the file can be decoded as it is, is no OpenEXR
/// file, has several parts, or is packed by DWA, which depends on names. Linear in the bytes.
/// Throws IoError if a header claims more than the file holds.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> exr_with_known_channels(
    const std::filesystem::path& path, PicturePart part);

}  // namespace episcope::io
