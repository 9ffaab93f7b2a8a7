// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace episcope::io {

struct ListedFile {
  std::filesystem::path path;
  std::uintmax_t bytes = 0;
  std::int64_t modified_ns = 0;  ///< Since 1970.
};

/// What lies directly in a folder, hidden things aside, by name.
struct FolderListing {
  std::filesystem::path folder;
  std::vector<ListedFile> files;  ///< Regular ones.
  std::vector<std::filesystem::path> folders;
  std::uint64_t fingerprint = 0;  ///< Of names, sizes and times of all this.
};

/// Throws filesystem_error for a folder that cannot be read.
[[nodiscard]] FolderListing list_folder(const std::filesystem::path& folder);

/// The file alone, as if it were all that its folder holds. Throws filesystem_error.
[[nodiscard]] FolderListing list_file(const std::filesystem::path& file);

}  // namespace episcope::io
