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

/// Whether this is a folder or a picture, which `read_scribble_pictures` reads, by its name.
[[nodiscard]] bool holds_scribble_pictures(const std::filesystem::path& path);

/// Reads the ids of every `scribbles_<v>_<u>.png` in a folder; or those of one picture, which is of
/// the centre view unless its name says another. Throws IoError, also if there is none, or if one
/// lies outside `grid` or has another size than `height` × `width`.
[[nodiscard]] Scribbles read_scribble_pictures(const std::filesystem::path& path, GridShape grid,
                                               int height, int width);

}  // namespace episcope::io
