// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"

#include <filesystem>
#include <map>
#include <string>

namespace episcope::test {

/// Channels of one size by name, as OpenEXR stores them: 32-bit floats, not packed.
using ExrChannels = std::map<std::string, ImageView<const float>>;

void write_exr(const std::filesystem::path& path, const ExrChannels& channels);

}  // namespace episcope::test
