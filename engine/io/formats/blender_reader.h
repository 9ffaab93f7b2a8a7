// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/camera_grid.h"
#include "engine/core/indices.h"
#include "engine/core/scene.h"
#include "engine/io/models/reader.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Folders that the Blender add-on (`resources/blender`) renders to: a manifest `light_field.json`,
/// a picture of every view, and depth and labels as `.npy`. During rendering, the complete views
/// around the center are read.
[[nodiscard]] Reader blender_reader();

/// The manifest of a folder that the Blender add-on renders to.
inline constexpr const char* kRenderManifest = "light_field.json";

/// Contents of a manifest.
struct RenderManifest {
  std::filesystem::path folder;
  std::string blender;  ///< The version that rendered it; empty = not stated.
  GridShape grid;
  int height = 0;
  int width = 0;
  CameraGrid camera;
  std::optional<Interval> disparity_range;
  std::map<std::string, std::string> files;  ///< Patterns by what they hold: "views", "depth", ….
  std::vector<LabelInfo> labels;
  std::vector<ViewIndex> complete;  ///< Views all of whose files are there.

  [[nodiscard]] bool has(const std::string& part) const { return files.contains(part); }
  /// Precondition: `has(part)`.
  [[nodiscard]] std::filesystem::path file(const std::string& part, ViewIndex view) const;
};

/// Whether the folder holds a manifest of a light field, as its first kilobyte tells.
[[nodiscard]] bool has_render_manifest(const std::filesystem::path& folder);

/// Throws IoError that says what is wrong with the manifest.
[[nodiscard]] RenderManifest read_render_manifest(const std::filesystem::path& folder);

}  // namespace episcope::io
