// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"

#include <filesystem>

namespace episcope::io {

/// Writes a folder of images, one for each view, named `RR_CC.png` by row and column from 0 on:
/// PNG of 8 or 16 bit, or TIFF of 32-bit float. Beside them, for every view that has them,
/// `disparity_RR_CC.npy` (float, px per view step, NaN = invalid) and `label_RR_CC.npy` (int32),
/// and region masks of the centre view as `mask_<name>.npy` (uint8). Atomic. Throws IoError (also
/// if the folder holds other files), Cancelled.
void write_grid_folder(const std::filesystem::path& folder, const Scene& scene,
                       const Progress& progress);

}  // namespace episcope::io
