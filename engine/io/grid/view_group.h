// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/grid/view_names.h"

#include <filesystem>
#include <vector>

namespace episcope::io {

/// Finds the views among the images of a folder by their names alone. Names that differ in numbers
/// only form a group (name_parts.h); the views are the group that forms the largest grid
/// (index_fields.h). Groups named like what belongs to views (label, depth, …) come last; of groups
/// equal in this, the one of the largest images, then of colour, then of names without words, then
/// of a format without loss. Throws IoError that names the option `pattern` if there is none, or if
/// two have equal right.
[[nodiscard]] ViewNames find_view_names(const std::filesystem::path& folder,
                                        const std::vector<std::filesystem::path>& images);

/// The images whose names match a user's pattern (NamePattern); maybe none. Throws InvalidInput for
/// a wrong pattern.
[[nodiscard]] ViewNames match_view_names(const std::vector<std::filesystem::path>& images,
                                         const std::string& pattern);

}  // namespace episcope::io
