// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace episcope::io {

/// Image files of the views of a grid, row by row from view (0, 0) on.
struct ViewFiles {
  GridShape grid;
  std::vector<std::filesystem::path> files;
};

/// Called with an 8-bit RGB picture of the centre view before the others are read.
using OnCenterView = std::function<void(const Image<std::uint8_t>& center_rgb)>;

/// Decodes the views in parallel, the centre first. Throws IoError that names the file if one
/// cannot be decoded or differs in size, channels or depth from the centre view; Cancelled.
[[nodiscard]] LightField::Samples load_views(const ViewFiles& views, const OnCenterView& on_center,
                                             const Progress& progress);

}  // namespace episcope::io
