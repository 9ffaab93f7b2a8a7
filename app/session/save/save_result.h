// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope {

/// Forms of a disparity map, told by the suffix of its file.
enum class MapForm {
  Result,     ///< .h5, .hdf5: all views, confidence, provenance.
  Pfm,        ///< .pfm: one view.
  Tiff,       ///< .tif, .tiff: likewise.
  Npy,        ///< .npy: likewise.
  PointCloud  ///< .ply: one view, coloured.
};
/// Empty for another suffix.
[[nodiscard]] std::optional<MapForm> map_form_of(const std::filesystem::path& path);

/// Writes a result file; `input` is what opens the light field. Atomic. Throws IoError, Cancelled.
void save_result(const std::filesystem::path& path, const Estimate& estimate,
                 const std::string& input, const Progress& progress);

/// Writes one map as PFM, TIFF or .npy; invalid pixels become NaN. Atomic. Throws IoError.
void save_map(const std::filesystem::path& path, const DisparityView& map);

/// Writes the valid pixels of a view that the light field shows as a coloured point cloud. Atomic.
/// Throws IoError, InvalidInput if no pixel is valid.
void save_point_cloud(const std::filesystem::path& path, const LightField& light_field,
                      ViewIndex view, const DisparityView& map);

}  // namespace episcope
