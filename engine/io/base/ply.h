// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/point_cloud.h"

#include <filesystem>

namespace episcope::io {

enum class PlyForm { Binary, Text };

/// Writes PLY, axes as `PointCloud`: x to the right, y upwards, the viewer looks along −z.
/// Triangles become faces. Atomic. Throws IoError, InvalidInput if there is no point.
void write_ply(const std::filesystem::path& path, const PointCloud& cloud,
               PlyForm form = PlyForm::Binary);

}  // namespace episcope::io
