// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/plenoptic/raw_picture.h"

#include <filesystem>
#include <string>

namespace episcope::capture {

/// The white picture that fits best, and why it was taken.
struct ChosenWhite {
  RawPicture picture;
  std::string reason;  ///< A sentence with the numbers, for users.
};

/// Reads a white picture from a file (picture, container, bare .raw), or chooses the nearest of the
/// calibration data of a Lytro camera: MOD_nnnn.RAW with their .TXT in a folder, in a tar
/// (caldata-<serial>.tar), or in storage containers (data.C.0 …), alone or in the folder. Throws
/// IoError, InvalidInput.
[[nodiscard]] ChosenWhite read_white(const std::filesystem::path& path, const RawPicture& raw);

/// A file beside a raw picture: NAME_white.* or white.* (`kind` "white"; likewise "dark"), or for
/// white also the calibration data there: caldata-*.tar, data.C.0, MOD_0000.RAW. Empty if there is
/// none.
[[nodiscard]] std::filesystem::path find_beside(const std::filesystem::path& raw,
                                                const std::string& kind);

}  // namespace episcope::capture
