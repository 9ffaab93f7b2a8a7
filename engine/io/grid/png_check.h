// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace episcope::io {

/// Whether a file begins as a PNG but is truncated or has a chunk whose checksum is wrong. False
/// for files of other kinds.
[[nodiscard]] bool is_damaged_png(const std::filesystem::path& path);

}  // namespace episcope::io
