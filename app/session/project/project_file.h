// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/project/project.h"

#include <filesystem>
#include <string>

namespace episcope {

/// Suffix of project files.
inline constexpr const char* kProjectSuffix = ".episcope";

/// Whether a path is named like a project file.
[[nodiscard]] bool names_project(const std::filesystem::path& path);

/// Writes a project file, JSON. Paths in it are relative to its folder wherever they share more
/// than the root, so that all can move together. Every result must have a file. Atomic. Throws
/// IoError.
void write_project(const std::filesystem::path& path, const Project& project);

/// Where results, strokes and labels of a project may be.
enum class ProjectFiles {
  Beside,   ///< Below the folder of the project: a project of the user's.
  Anywhere  ///< A workspace, which names those of the project that it goes on from.
};

/// Reads a project file; paths come back absolute. Whether the files are there is not looked at.
/// Light fields and meshes may be anywhere; other files are copied when the project is saved, so
/// one that came from somewhere must not name those of the reader. Throws IoError with one
/// sentence, also for a file that is not where `files` says.
[[nodiscard]] Project read_project(const std::filesystem::path& path,
                                   ProjectFiles files = ProjectFiles::Beside);

}  // namespace episcope
