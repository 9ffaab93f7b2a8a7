// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace episcope {

/// A movie as a player sees it.
struct PlayedMovie {
  std::vector<Image<std::uint8_t>> pictures;  ///< RGB8.
  double seconds = 0;
};

/// Decodes a whole movie. Nothing in it if it cannot be read.
[[nodiscard]] PlayedMovie read_movie(const std::filesystem::path& path);

}  // namespace episcope
