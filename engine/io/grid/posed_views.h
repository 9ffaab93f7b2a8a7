// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/grid/view_names.h"
#include "engine/io/open/open_options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// Views placed by the poses of their cameras.
struct PosedViews {
  std::vector<std::filesystem::path> files{};  ///< Of the poses; empty = there are none.
  PlacedViews placed{};
  double step = 0;          ///< Of neighbouring cameras, in units of the scene.
  double focal_widths = 0;  ///< Focal length in widths of a view; 0 = not stated.
  std::string evidence{};   ///< For the report: "9×9 by transforms.json: cameras in steps of …".
  std::string problem{};    ///< Why the poses are not used, as a clause; empty if they are.

  [[nodiscard]] bool are_used() const { return !files.empty() && problem.empty(); }
  /// "transforms.json": what the files of the poses are called.
  [[nodiscard]] std::string name() const;
};

/// The views of a folder that has, or whose parent has, files of poses (read_poses.h), where these
/// are those of a light field (pose_grid.h); not where options say how names are meant.
[[nodiscard]] PosedViews place_by_poses(const std::filesystem::path& folder,
                                        const OpenOptions& options);

/// Whether a folder has no images but in the folders inside that its files of poses speak of.
[[nodiscard]] bool has_parts_with_poses(const std::filesystem::path& folder);

/// Throws IoError that says why the poses are not those of a light field.
[[noreturn]] void refuse_poses(const std::filesystem::path& folder, const PosedViews& poses);

}  // namespace episcope::io
