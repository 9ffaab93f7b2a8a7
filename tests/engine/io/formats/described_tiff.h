// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace episcope::test {

/// Gives a TIFF file, little-endian and without one, the text ImageDescription, in which programs
/// say what its pages are: its first directory is written anew at the end.
void describe_tiff(const std::filesystem::path& path, const std::string& text);

}  // namespace episcope::test
