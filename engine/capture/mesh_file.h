// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/triangle_mesh.h"
#include "engine/core/progress.h"

#include <filesystem>

namespace episcope::capture {

/// Reads a mesh: PLY (ascii or binary), OBJ or STL, all of its parts as one, polygons as triangles.
/// Throws IoError for a file that is damaged or of another kind, that has no faces, coordinates
/// that are not finite, faces of vertices that do not exist, or more than a 32-bit index counts;
/// Cancelled.
[[nodiscard]] TriangleMesh read_mesh(const std::filesystem::path& path, const Progress& progress);

/// Writes binary PLY. Atomic. Throws IoError.
void write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace episcope::capture
