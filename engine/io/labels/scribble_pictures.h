// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"

#include <filesystem>
#include <vector>

namespace episcope::io {

/// Writes two PNG for each painted view into an existing folder: `scribbles_<v>_<u>.png` holds the
/// ids (8-bit grey, 16-bit if one is above 255; 0 = unpainted), `scribbles_<v>_<u>_preview.png` the
/// colours of the labels on a transparent ground. Views are numbered in canonical order, two digits
/// each. Returns the files written. Each is atomic. Throws IoError.
std::vector<std::filesystem::path> write_scribble_pictures(const std::filesystem::path& folder,
                                                           const Scribbles& scribbles);

/// Reads the ids of every `scribbles_<v>_<u>.png` in a folder. Throws IoError, also if there is
/// none, or if one lies outside `grid` or has another size than `height` × `width`.
[[nodiscard]] Scribbles read_scribble_pictures(const std::filesystem::path& folder, GridShape grid,
                                               int height, int width);

}  // namespace episcope::io
