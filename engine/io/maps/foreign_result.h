// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"

#include <filesystem>
#include <string>

namespace episcope::io {

/// A disparity map as other programs write it: PFM, 32-bit float TIFF, `.npy` of two or four
/// axes, or an HDF5 file with one 2-D or 4-D dataset of float samples. A 2-D map belongs to the
/// centre view of `grid`. Values that are not finite become invalid pixels. Throws IoError with one
/// sentence.
[[nodiscard]] DisparityField read_disparity_map(const std::filesystem::path& path, GridShape grid);

/// A result of another program: a file as above, or a folder of the 2016 submission form
/// (`disp_maps/<scene>.pfm`, `runtimes/<scene>.txt`), of which `scene` picks the map. Throws
/// IoError.
[[nodiscard]] Estimate read_foreign_result(const std::filesystem::path& path, GridShape grid,
                                           const std::string& scene);

/// Marks values that are not finite as invalid and sets them to 0.
void mark_invalid(DisparityField& field);

}  // namespace episcope::io
