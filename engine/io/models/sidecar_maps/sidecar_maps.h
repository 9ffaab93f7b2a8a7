// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/io/models/file_usage.h"
#include "engine/io/models/sidecar_maps/disparity_units.h"
#include "engine/io/models/sidecar_maps/map_sets.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace episcope::io {

/// Truth that lies beside views, in their stored order.
struct FoundBeside {
  GroundTruth truth;
  std::vector<LabelInfo> label_infos;  ///< Names and colours of its labels, as far as known.
  CameraGrid camera;                   ///< As given, or what disparity and depth say together.
  bool is_sign_assumed = false;        ///< Nothing tells near from far in the disparity.
};

/// Finds (`find_maps`) and reads disparity, depth, labels and masks beside views. Every file that
/// was looked at goes to the account, used or left out, with the reason; units and how they were
/// checked go to the report. What is damaged or does not fit is left out with a warning: views
/// open without it. Throws Cancelled.
[[nodiscard]] FoundBeside read_beside(const BesideViews& views, const BesideNotes& notes,
                                      const Progress& progress);

/// The unit that this file states, which is then noted in the account; empty without one.
[[nodiscard]] std::optional<MapUnit> stated_unit(const std::filesystem::path& folder,
                                                 FolderAccount& account);

}  // namespace episcope::io
