// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/io/models/assemble_scene.h"
#include "engine/io/models/sidecar_maps/disparity_units.h"
#include "engine/io/models/sidecar_maps/map_sets.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace episcope::io {

/// Truth that lies beside views, in their stored order.
struct SidecarMaps {
  GroundTruth truth;
  std::vector<LabelInfo> label_infos;  ///< Names and colors of its labels, if known.
  CameraGrid camera;                   ///< As given, or what disparity and depth say together.
  bool is_sign_assumed = false;        ///< Nothing tells near from far in the disparity.
};

/// Finds (`find_maps`) and reads disparity, depth, labels and masks beside views. Records every
/// file as used or left out, with the reason. Reports units and how they were checked. Omits
/// damaged and unfitting files with a warning: views open without them. Throws Cancelled.
[[nodiscard]] SidecarMaps read_sidecar_maps(const SidecarViews& views, const SidecarNotes& notes,
                                            const Progress& progress);

/// Adds disparity, labels and masks from files called after a light field that is one file
/// ("cotton_disparity.npy" beside "cotton.h5") to `parts`, which hold no disparity. Returns names
/// and colors of the labels. Throws Cancelled.
std::vector<LabelInfo> add_maps_named_after(const std::filesystem::path& file,
                                            const OpenOptions& options, SceneParts& parts,
                                            const SidecarNotes& notes, const Progress& progress);

/// Unit according to `kBaselineFile`, which is recorded as used; empty without such a file.
[[nodiscard]] std::optional<MapUnit> stated_unit(const std::filesystem::path& folder,
                                                 FileUsage& account);

/// Applies masks of valid and of invalid pixels beside the views to disparity that came from
/// elsewhere.
void apply_masks_beside(const SidecarViews& views, const SidecarNotes& notes,
                        DisparityField& field);

}  // namespace episcope::io
