// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/reader.h"

namespace episcope::io {

/// Folders that the Blender add-on (`resources/blender`) renders to: a manifest `light_field.json`,
/// a picture of every view, and depth and labels as `.npy`. While rendering goes on, the complete
/// views around the centre are read.
[[nodiscard]] Reader blender_reader();

}  // namespace episcope::io
