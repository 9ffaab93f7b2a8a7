// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/arrays/array_file.h"

#include <filesystem>
#include <memory>

namespace episcope::io {

/// The arrays of a MATLAB file of version 5 to 7.3. Throws IoError for a file of another kind, or a
/// damaged one.
[[nodiscard]] std::unique_ptr<const ArrayFile> open_matlab_file(const std::filesystem::path& path);

}  // namespace episcope::io
