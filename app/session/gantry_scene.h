// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/load_scene.h"
#include "engine/capture/calibrate.h"
#include "engine/capture/demo_folder.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// Id of the synthetic gantry, `demo:gantry`: a light field of photographs that are not rectified.
inline constexpr const char* kGantryScene = "gantry";

/// Whether what follows `demo:` is the gantry, with options or without.
[[nodiscard]] bool is_gantry(const std::string& id);

/// Options as of other built-in scenes: seed, size, grid, noise. Throws InvalidInput.
[[nodiscard]] capture::DemoOptions gantry_options(const std::string& id);

/// Files of the gantry, in a folder of the cache.
struct GantryFolder {
  std::filesystem::path path;

  [[nodiscard]] std::filesystem::path photographs() const { return path / "photographs"; }
  /// Of the calibration pattern (capture::demo_pattern), by name.
  [[nodiscard]] std::vector<std::filesystem::path> pattern() const;
  [[nodiscard]] std::filesystem::path mesh() const { return path / "mesh.ply"; }
  /// Points that were picked in the photograph of the center.
  [[nodiscard]] std::filesystem::path picks() const { return path / "picks.csv"; }
};

/// The folder that an input belongs to: the folder of `demo:gantry`, or the one that a file lies
/// in. None for other inputs and missing folders.
[[nodiscard]] std::optional<GantryFolder> gantry_folder(const std::string& input,
                                                        const std::filesystem::path& cache_folder);

/// Reads the photographs from the cache, or makes them and keeps them there with pattern, mesh and
/// picks. Without a writable cache folder, makes the photographs only. The center view is shown
/// first. Throws InvalidInput, Cancelled.
[[nodiscard]] Scene load_gantry(const std::string& id, const LoadOptions& options,
                                const Progress& progress);

}  // namespace episcope
