// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/base/image_file.h"

#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// How a camera was held, as JPEG, PNG and WebP files state it (Exif 2.3, tag 0x0112): 1 = upright,
/// 3 = upside down, 6 and 8 = turned by a quarter, others mirrored. 1 for other files, of which
/// TIFF is decoded upright, and where nothing is stated. Reads headers only, and throws nothing.
[[nodiscard]] int exif_orientation(const std::filesystem::path& path);

/// The image as it is to be looked at.
[[nodiscard]] AnyImage upright(const AnyImage& stored, int orientation);
/// Whether rows and columns of pixels are exchanged in that.
[[nodiscard]] constexpr bool is_quarter_turn(int orientation) {
  return orientation > 4;
}

/// The orientation in which views are to be shown, and a sentence about it if it is not that of
/// the samples: that of all files, or 1 if they differ.
struct CommonOrientation {
  int value = 1;
  std::string note;
};
[[nodiscard]] CommonOrientation common_orientation(const std::vector<std::filesystem::path>& files);

}  // namespace episcope::io
