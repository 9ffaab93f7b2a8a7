// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/grid/name_parts.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace episcope::io {

/// Joins groups whose names differ in one letter that stands alone and runs from a on, as in A1,
/// A2 … C9: the letter then is a number, from 1 on. Three letters at least, with as many images
/// each, that form a grid together; other groups stay as they are.
void join_lettered_rows(std::vector<NameGroup>& groups);

/// The folders in the order of their letters, if these are their names and run from a on; at least
/// three.
[[nodiscard]] std::optional<std::vector<std::filesystem::path>> by_letter(
    std::vector<std::filesystem::path> folders);

}  // namespace episcope::io
