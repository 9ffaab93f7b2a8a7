// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parallel/progress.h"
#include "engine/io/open/assemble_scene.h"

#include <filesystem>
#include <string>

namespace episcope::io {

/// Whether the file itself says that the views of a list are a row, if they do not tell otherwise.
enum class StoredAs { List, Row };

/// Puts views (and maps of all views) that were read as a list, 1×N, onto their grid: the one that
/// the options state, row by row, else the one that the views themselves speak for. `reason` is
/// continued. Throws Undecided where the views do not tell and are not stored as a row;
/// InvalidInput if the grid does not have as many places; Cancelled.
void arrange_list(const std::filesystem::path& path, const OpenOptions& options, SceneParts& parts,
                  std::string& reason, const Progress& progress, StoredAs stored = StoredAs::List);

}  // namespace episcope::io
