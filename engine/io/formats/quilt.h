// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope::io {

/// Quilts, the pictures of light-field displays: the views of one row of cameras side by side, the
/// camera at the left in the tile at the bottom left, its neighbor right of it, the last one at the
/// top right. The name states columns, rows and the aspect of a view: "flower_qs8x6a0.75.png".
/// Source: Looking Glass Factory, "Quilts" (docs.lookingglassfactory.com).

/// Rows and columns of tiles that the name of a file states; empty if it states none.
[[nodiscard]] std::optional<GridShape> quilt_tiles_of_name(const std::filesystem::path& path);

/// "flower" of "flower_qs8x6a0.75"; other names as they are.
[[nodiscard]] std::string without_quilt_tiles(const std::string& stem);

/// Tile of a view, both from 0, tiles from the top left.
[[nodiscard]] ViewIndex quilt_tile(GridShape tiles, int view);

/// Tiles for one row of a light field in a picture as square as the number of views allows.
[[nodiscard]] GridShape quilt_tiles_of(const LightField& field);

/// The name with the tiles that `write_quilt` writes: "flower_qs3x3a1.25.png" of "flower.png". A
/// name that states tiles stays.
[[nodiscard]] std::filesystem::path quilt_path(const std::filesystem::path& path,
                                               const LightField& field);

/// Writes the middle row of views as a PNG, 8 or 16 bit as they are, with the tiles that the name
/// states or else `quilt_tiles_of`. Atomic. Throws IoError, also for float samples, a single column
/// of views, and tiles that are not as many as views; Cancelled.
void write_quilt(const std::filesystem::path& path, const Scene& scene, const Progress& progress);

}  // namespace episcope::io
