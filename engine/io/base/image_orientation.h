// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/base/image_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// Orientation of the camera as stated in JPEG, PNG and WebP files (Exif 2.3, tag 0x0112): 1 =
/// upright, 3 = upside down, 6 and 8 = turned by a quarter, others mirrored. 1 for other files
/// (TIFF is decoded upright) and where nothing is stated. Reads headers only. Throws nothing.
[[nodiscard]] int exif_orientation(const std::filesystem::path& path);

/// Turns the image upright.
[[nodiscard]] AnyImage upright(const AnyImage& stored, int orientation);
/// Whether this orientation exchanges rows and columns of pixels.
[[nodiscard]] constexpr bool is_quarter_turn(int orientation) {
  return orientation > 4;
}

/// Orientation in which to show views: the one that all files state, or 1 if they differ. `note` is
/// a sentence for the report if samples are not stored so.
struct CommonOrientation {
  int value = 1;
  std::string note;
};
[[nodiscard]] CommonOrientation common_orientation(const std::vector<std::filesystem::path>& files);

}  // namespace episcope::io
