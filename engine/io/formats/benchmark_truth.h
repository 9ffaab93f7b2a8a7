// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/models/sidecar_maps/map_sets.h"

#include <filesystem>
#include <string>

namespace episcope::io {

/// Names of files in a scene folder of the 2016 benchmark; views have three digits.
inline constexpr const char* kBenchmarkConfig = "parameters.cfg";
inline constexpr const char* kViewPrefix = "input_Cam";
/// Truth of the center view: disparity or depth, and ids of objects.
inline constexpr const char* kCenterDisparity = "gt_disp_lowres.pfm";
inline constexpr const char* kCenterDepth = "gt_depth_lowres.pfm";
inline constexpr const char* kObjectIds = "objectids_lowres.png";
/// How names of region masks end.
inline constexpr const char* kMaskSuffix = "_lowres.png";

/// "input_Cam007.png".
[[nodiscard]] std::string view_file_name(int index);
/// "gt_disp_lowres_Cam007.pfm".
[[nodiscard]] std::string disparity_file_name(int index);
/// "planes" of "mask_planes_lowres.png", if names of masks end in "_lowres.png"; else empty.
[[nodiscard]] std::string region_of(const std::filesystem::path& mask, const std::string& suffix);

/// Reads disparity of the 2016 benchmark; larger is nearer. `gt_disp_lowres_Cam*.pfm` covers all
/// views, `gt_disp_lowres.pfm` the center view, or `gt_depth_lowres.pfm` if the camera is known.
/// Empty if there is none. Files that are damaged or do not fit are ignored with a warning, and
/// their views are invalid. Throws Cancelled.
[[nodiscard]] DisparityField read_benchmark_disparity(const std::filesystem::path& folder,
                                                      const SidecarViews& views,
                                                      const SidecarNotes& notes,
                                                      const Progress& progress);

/// Adds labels, region masks and the truth in high resolution to `truth`; ignores damaged files
/// likewise.
void read_benchmark_masks(const std::filesystem::path& folder, const SidecarViews& views,
                          const SidecarNotes& notes, GroundTruth& truth);

}  // namespace episcope::io
