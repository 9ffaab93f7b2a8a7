// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace episcope {

/// Where a folder was and where it is now.
struct MovedFolder {
  std::filesystem::path from;
  std::filesystem::path to;
};

/// The outermost folders by which two paths of the same light field differ.
[[nodiscard]] MovedFolder moved_folder(const std::filesystem::path& from,
                                       const std::filesystem::path& to);

/// Where an input is after its folder was moved, if it is not where it was and is there; else
/// empty.
[[nodiscard]] std::string moved_input(const std::string& input, const MovedFolder& moved);

}  // namespace episcope
