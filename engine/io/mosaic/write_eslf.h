// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"

#include <filesystem>

namespace episcope::io {

/// Writes the views as one PNG of lenslets: pixel (x, y) of view (v, u) at (x·columns + u,
/// y·rows + v), 8 or 16 bit as they are. Truth, labels and the camera have no place in it. Atomic.
/// Throws IoError, also for float samples; Cancelled.
void write_eslf(const std::filesystem::path& path, const Scene& scene, const Progress& progress);

}  // namespace episcope::io
