// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"

#include <filesystem>

namespace episcope {

/// Where the scribbles of a light field are kept: labels.h5 in its folder, or beside an archive
/// file; <stem>_labels.h5 beside a file of another form; of a frame of a sequence, in the frame's
/// folder, or labels_<frame>.h5 beside its file. Empty for scenes that come from no file.
[[nodiscard]] std::filesystem::path label_place(const LightField& light_field);

/// Whether a file can be made or written over there, as far as permissions tell.
[[nodiscard]] bool is_writable(const std::filesystem::path& path);

/// Reads scribbles that were saved beside a light field whose format knows of no labels. Where
/// that file does not fit, that is a warning. Throws Cancelled.
void read_kept_scribbles(Scene& scene, const Progress& progress);

}  // namespace episcope
