// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/libraries/library_versions.h"

#include <string>
#include <vector>

namespace episcope {

/// The lines of `--version`: "<program> <version>", the commit, and the libraries by name: those of
/// the engine and `others`. Ends with a new line.
[[nodiscard]] std::string version_text(const std::string& program,
                                       const std::vector<LibraryVersion>& others);

}  // namespace episcope
