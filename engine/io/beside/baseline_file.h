// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/beside/map_scale.h"
#include "engine/io/open/folder_account.h"

#include <filesystem>
#include <optional>

namespace episcope::io {

/// Name of the file beside views in which the Cambridge set for view interpolation states
/// `base_x`, the distance of neighbouring cameras; disparity is stored for a distance of 1.
inline constexpr const char* kBaselineFile = "param.txt";

/// The unit that this file states, which is then noted in the account; empty without one.
[[nodiscard]] std::optional<MapUnit> stated_unit(const std::filesystem::path& folder,
                                                 FolderAccount& account);

}  // namespace episcope::io
