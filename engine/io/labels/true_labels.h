// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_stack.h"
#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"

#include <cstdint>
#include <filesystem>

namespace episcope::io {

/// Reads the true labels (dataset GT_LABELS) of a file in archive form, `[v][u][y][x]` in canonical
/// order: the file is assumed to store views and labels as the light field's own files do. Views
/// that the file lacks are not covered. A focus plane baked into the scene (shear.h) is applied.
/// Throws IoError if the file has no GT_LABELS or they do not fit the light field; Cancelled.
[[nodiscard]] ViewStack<std::int32_t> read_true_labels(const std::filesystem::path& path,
                                                       const Scene& scene,
                                                       const Progress& progress);

}  // namespace episcope::io
