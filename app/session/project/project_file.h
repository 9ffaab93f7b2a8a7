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

/// Reads a project file; paths come back absolute. Whether the files are there is not looked at.
/// Throws IoError with one sentence.
[[nodiscard]] Project read_project(const std::filesystem::path& path);

}  // namespace episcope
