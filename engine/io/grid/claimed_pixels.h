// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace episcope::io {

/// Pixels that the header of a picture claims, before any of them is decoded: JPEG, BMP, PNM, TIFF,
/// WebP, JPEG 2000, OpenEXR, Radiance. Nothing for other forms.
[[nodiscard]] std::optional<std::uint64_t> claimed_pixels(const std::filesystem::path& path);

/// Throws IoError if a picture claims more pixels than its file can hold, compressed as densely as
/// can be, unless they are few (16 million).
void require_plausible_picture(const std::filesystem::path& path);

/// The same for so many pixels that are claimed.
void require_plausible_pixels(const std::filesystem::path& path, std::uint64_t claimed);

/// Pixels that a picture of a file of so many bytes may claim.
[[nodiscard]] std::uint64_t most_plausible_pixels(std::uintmax_t bytes);

}  // namespace episcope::io
