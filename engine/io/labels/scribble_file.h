// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"

#include <filesystem>

namespace episcope::io {

/// If a focus plane is baked into the scene (shear.h), files keep to the views as they are stored:
/// reading moves to the plane, writing moves back.

/// Reads the scribbles of `scene` from a file of the archive form (labels.h5), in the house order:
/// views of the file are ordered as those of the light field's own files. Names and colours are
/// those in the file; none in files of others. Throws IoError if the file holds no SCRIBBLES or
/// they do not fit the light field; Cancelled.
[[nodiscard]] Scribbles read_scribbles(const std::filesystem::path& path, const Scene& scene,
                                       const Progress& progress);

/// Writes scribbles as the archive keeps them, with names and colours in attributes
/// that others pass over. All else that the file holds stays as it is, above all GT_LABELS, and at
/// a focus plane its scribbles where the moved views do not reach. Atomic. Throws IoError, also if
/// the file is no HDF5 file, holds a light field or belongs to another one, or if a view of
/// `scribbles` does not fit; Cancelled.
void write_scribbles(const std::filesystem::path& path, const Scribbles& scribbles,
                     const Scene& scene, const Progress& progress);

}  // namespace episcope::io
