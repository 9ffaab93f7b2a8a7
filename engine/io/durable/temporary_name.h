// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace episcope::io {

/// A hidden name for what becomes `target` when it is whole, used by no other program on any
/// machine: `.NAME.<machine>-<process>-<random>-<count>.part`.
[[nodiscard]] std::string temporary_name(const std::filesystem::path& target);

/// Removes, as far as that can be done, what programs of this machine that were killed have left
/// under such names beside `target`. Linear in the number of files of its folder.
void remove_abandoned(const std::filesystem::path& target);

/// The folder that holds `target`.
[[nodiscard]] std::filesystem::path folder_of(const std::filesystem::path& target);

}  // namespace episcope::io
