// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/scene.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::accuracy {

/// Scenes of one kind.
struct SceneGroup {
  std::string name;
  /// "demo:<scene>" as the command line opens it, or the name of a stored scene.
  std::vector<std::string> scenes;
};

/// Scenes that serve one purpose: defaults are chosen on "choosing", and "reporting" tells how good
/// they are.
struct SceneSet {
  std::string name;
  std::vector<SceneGroup> groups;
};

/// Reads scenes.json. Throws IoError.
[[nodiscard]] std::vector<SceneSet> read_scene_sets(const std::filesystem::path& file);

/// Scenes of which only those are kept whose name contains one of `parts`; empty = all.
[[nodiscard]] SceneSet scenes_with(const SceneSet& set, const std::vector<std::string>& parts);

/// Opens a scene of a set. Built-in scenes have `size`×`size` pixels unless their name says another
/// size; a stored one is looked for in `data`, and nullopt if it is not there or has no truth for
/// its center view. Throws as the reader, and Unavailable or InvalidInput for a name that cannot be
/// read.
[[nodiscard]] std::optional<Scene> open_scene_of_set(const std::string& name, int size,
                                                     const std::filesystem::path& data,
                                                     const Progress& progress);

}  // namespace episcope::accuracy
