// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/io/open/assemble_scene.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope::io {

/// Puts views (and maps of all views) that were read as a list, 1×N, onto their grid: the one that
/// the options state, row by row, else the one that the views themselves speak for. `reason` is
/// continued. `stored` is the grid of which the file itself speaks, for views that do not tell
/// otherwise. Throws Undecided where neither tells;
/// InvalidInput if the grid does not have as many places; Cancelled.
void arrange_list(const std::filesystem::path& path, const OpenOptions& options, SceneParts& parts,
                  std::string& reason, const Progress& progress,
                  std::optional<GridShape> stored = std::nullopt);

}  // namespace episcope::io
