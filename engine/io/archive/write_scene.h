// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"

#include <filesystem>

namespace episcope::io {

/// Writes a scene in the form of the 2013 archive: the light field and its depth to
/// `path`, labels and scribbles to `labels.h5` beside it if the scene has them; where a `labels.h5`
/// of something else is there, they go into `path`. Rows are in canonical order, which the
/// attribute `convention` states. Atomic for each file. Throws IoError, Cancelled.
void write_archive(const std::filesystem::path& path, const Scene& scene, const Progress& progress);

/// Whether it puts the labels into `path` itself, because a `labels.h5` of something else is beside
/// it.
[[nodiscard]] bool puts_labels_inside(const std::filesystem::path& path, const Scene& scene);

/// Writes a folder of the 2016 benchmark form: images, cfg, PFM truth of the centre
/// view and, where known, of all views. Throws IoError (also if the folder holds other files),
/// Cancelled.
void write_benchmark_folder(const std::filesystem::path& folder, const Scene& scene,
                            const Progress& progress);

}  // namespace episcope::io
