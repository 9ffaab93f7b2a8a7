// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/sidecar_maps/map_name.h"
#include "engine/io/models/sidecar_maps/scene_files.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// A folder to look at, and what its own name says about its files.
struct MapPlace {
  std::filesystem::path folder;
  std::optional<MapKind> kind;
  std::string prefix = {};  ///< Of patterns: "disparity/".
  MapClaim claim = MapClaim::None;
  std::string scene = {};  ///< What the views are called, where this lies beside their folder.
  bool is_shared = false;  ///< Only files of that name belong to the views.
  std::optional<SceneFiles> owner = {};  ///< Tells which of its files belong to the views.
  std::vector<std::string> owners = {};  ///< Names of what maps belong to (`name_beside`).

  /// Whether a file is called as the views are.
  [[nodiscard]] bool is_called(const std::filesystem::path& file) const {
    return !scene.empty() && file.stem() == scene;
  }
  /// By its name alone.
  [[nodiscard]] bool may_hold(const std::filesystem::path& file) const {
    return (!is_shared || is_called(file)) && (!owner || owner->contains(file));
  }
};

/// Where maps of views in this folder may lie: there, in folders of maps inside it, around it if it
/// holds only the pictures of a scene (lf, views, the only grid, or a `kBaselineFile` in it), and
/// in folders of maps beside it, under its own name.
[[nodiscard]] std::vector<MapPlace> map_places(const std::filesystem::path& folder);

/// File beside views in which the Cambridge set for view interpolation states `base_x`, the
/// distance of neighboring cameras. Its disparity refers to a distance of 1.
inline constexpr const char* kBaselineFile = "param.txt";

}  // namespace episcope::io
