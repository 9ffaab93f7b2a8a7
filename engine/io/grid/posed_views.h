// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/grid/view_names.h"
#include "engine/io/open/open_options.h"

#include <filesystem>
#include <string>

namespace episcope::io {

/// Views placed by the poses of their cameras.
struct PosedViews {
  std::filesystem::path file{};  ///< Of the poses; empty = there is none.
  PlacedViews placed{};
  double step = 0;          ///< Of neighbouring cameras, in units of the scene.
  double focal_widths = 0;  ///< Focal length in widths of a view; 0 = not stated.
  std::string evidence{};   ///< For the report: "9×9 by transforms.json: cameras in steps of …".
  std::string problem{};    ///< Why the poses are not used, as a clause; empty if they are.

  [[nodiscard]] bool are_used() const { return !file.empty() && problem.empty(); }
};

/// The views of a folder that has, or whose parent has, a file of poses (read_poses.h), where these
/// are those of a light field (pose_grid.h); not where options say how names are meant.
[[nodiscard]] PosedViews place_by_poses(const std::filesystem::path& folder,
                                        const OpenOptions& options);

/// What to do about poses that are not those of a light field, for the end of a message.
inline constexpr const char* kPoseAdvice =
    "a light field has parallel cameras on a plane, in equal steps: render such views, or name "
    "rows "
    "and columns by --grid if these are some";

}  // namespace episcope::io
