// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/base/library_versions.h"

#include <string>
#include <vector>

namespace episcope {

/// The lines of `--version`: "<program> <version>", the commit, and the libraries of the engine
/// and `others` by name. Ends with a new line.
[[nodiscard]] std::string version_text(const std::string& program,
                                       const std::vector<LibraryVersion>& others);

/// The commit that was built, as `git describe --always --dirty` tells it; "unknown" where the
/// sources are no git checkout.
extern const char* const kCommit;

}  // namespace episcope
