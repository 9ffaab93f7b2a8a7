// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/app/kills/savers.h"

#include <map>

namespace episcope::test {

/// Bytes of files by their path from a folder.
using Contents = std::map<std::string, std::string>;

/// What is meant by a folder's contents: what a program leaves unfinished begins with a dot.
enum class Unfinished { Counts, IsLeftOut };

/// Every file below a folder.
[[nodiscard]] Contents contents_of(const std::filesystem::path& folder, Unfinished unfinished);

/// Of `savers()`. Throws std::runtime_error if there is none.
[[nodiscard]] Saver saver_named(const std::string& name);

/// The folder, there and empty.
std::filesystem::path empty_folder(const std::filesystem::path& folder);

}  // namespace episcope::test
