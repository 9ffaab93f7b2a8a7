// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace episcope::test {

/// Channels of one size by name, as OpenEXR stores them: 32-bit floats, not packed.
using ExrChannels = std::map<std::string, ImageView<const float>>;

/// The window of the picture by its first and last pixel, where the stored ones begin at (0, 0).
struct DisplayWindow {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// Without a window the picture is what is stored.
void write_exr(const std::filesystem::path& path, const ExrChannels& channels,
               const std::optional<DisplayWindow>& display = {});

}  // namespace episcope::test
