// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"

#include <filesystem>

namespace episcope::io {

/// Throws IoError with one sentence unless `path` is a file that can be opened for reading.
void require_readable_file(const std::filesystem::path& path);

/// Why writing to `path` failed and what to do about it, from `errno` and the free space.
[[nodiscard]] IoError write_error(const std::filesystem::path& path);

}  // namespace episcope::io
