// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"

#include <filesystem>

namespace episcope::io {

/// If a focus plane is baked into the scene (shear.h), files keep the views as stored: reading
/// moves scribbles to the plane, writing moves them back.

/// Reads the scribbles of `scene` from a file in archive form (labels.h5), in canonical order: the
/// file is assumed to store views in the order of the light field's own files. Names and colours
/// are those in the file; files of other programs have none. Throws IoError if the file has no
/// SCRIBBLES or they do not fit the light field; Cancelled.
[[nodiscard]] Scribbles read_scribbles(const std::filesystem::path& path, const Scene& scene,
                                       const Progress& progress);

/// Writes scribbles in archive form, with names and colours in attributes that other readers
/// ignore. Everything else in the file is preserved, in particular GT_LABELS, and, with a focus
/// plane, its scribbles outside the moved views. Atomic. Throws IoError, also if the file is not an
/// HDF5 file, holds a light field or belongs to another one, or if a view of `scribbles` does not
/// fit; Cancelled.
void write_scribbles(const std::filesystem::path& path, const Scribbles& scribbles,
                     const Scene& scene, const Progress& progress);

}  // namespace episcope::io
