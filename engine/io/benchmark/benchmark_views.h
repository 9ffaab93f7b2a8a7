// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/benchmark/config_file.h"
#include "engine/io/grid/load_views.h"
#include "engine/io/open/scene_probe.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope::io {

/// Number of images input_Cam* in a folder: with a number of any padding, upper or lower case.
[[nodiscard]] int count_benchmark_views(const std::filesystem::path& folder);

/// Views of a scene, and what is missing from them.
struct BenchmarkViews {
  ViewFiles views;
  std::string gaps;  ///< A sentence (`part_text`); empty if nothing is missing.
};

/// Views by their index from 0, or from 1, row by row from the top left: of the grid that was
/// given, else that of `config`, else a square; in the folder, or in the only one inside it that
/// has some. If some are missing, the part of the grid without gaps (`part_to_open`). Throws
/// IoError, also if there is no such part.
[[nodiscard]] BenchmarkViews benchmark_views(const std::filesystem::path& folder,
                                             const std::optional<ConfigFile>& config,
                                             const std::optional<GridShape>& given);

/// What names and headers of a scene folder tell. Throws IoError.
[[nodiscard]] SceneProbe probe_benchmark(const std::filesystem::path& folder,
                                         const OpenOptions& options);

}  // namespace episcope::io
