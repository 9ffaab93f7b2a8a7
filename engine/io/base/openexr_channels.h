// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace episcope::io {

/// What of an OpenEXR file is wanted, which may hold both.
enum class PicturePart { Colours, Depth };

/// An OpenEXR file whose channels have names that OpenCV does not know: the layers of a render
/// (`View Layer.Combined.R`), or depth (`Z`, `V`, `View Layer.Depth.Z`). Returns its bytes with
/// such names that OpenCV decodes the part: of layers the combined one, else the first that has
/// red, green and blue; of a file without colours the depth, or the only channel. `Depth` is that
/// channel also beside colours. Nothing if the file can be decoded as it is, is no OpenEXR file, or
/// is one in several parts or packed by DWA, which goes by the names. Linear in the bytes.
/// Throws IoError if a header claims more than the file holds.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> exr_with_known_channels(
    const std::filesystem::path& path, PicturePart part);

}  // namespace episcope::io
