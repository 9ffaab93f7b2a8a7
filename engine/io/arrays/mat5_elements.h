// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"

#include <filesystem>

namespace episcope::io {

/// What is said of a MATLAB 5 file that is not whole.
[[nodiscard]] IoError damaged_mat5(const std::filesystem::path& path);

/// Follows the lengths of all elements of a MATLAB 5 file: each must end within what holds it. The
/// library believes them: it reads what is missing in a truncated file as if it were there, and
/// takes gigabytes for dimensions of that length. Of compressed variables of more than 64 MiB
/// that hold no others only the beginning is looked at; of smaller ones the library would leave
/// what it cannot unpack as it was in memory. Throws IoError. Source: The MathWorks, MAT-File
/// Format, R2015b, chapter 1.
void require_sound_elements(const std::filesystem::path& path);

}  // namespace episcope::io
