// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/collection/collection_entry.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace episcope::io {

/// What folders held when they were last looked at, in a file that may be lost or damaged at any
/// time: then everything is looked at again. It keeps only the folders of the last listing.
class CollectionCache {
 public:
  /// Reads the file, if there is one that this version wrote with the same readers. An empty path
  /// keeps nothing.
  explicit CollectionCache(std::filesystem::path file);

  /// What the folder held when it had this fingerprint (folder_listing.h); null if that is not
  /// known.
  [[nodiscard]] const FolderRecord* find(const std::filesystem::path& folder,
                                         std::uint64_t fingerprint) const;
  void keep(const std::filesystem::path& folder, std::uint64_t fingerprint, FolderRecord record);
  /// Writes what was kept, unless that is what was read. Does nothing where that is not possible.
  void save() const;

 private:
  struct Kept {
    std::uint64_t fingerprint = 0;
    FolderRecord record;
  };
  using Records = std::map<std::string, Kept>;

  void read();

  std::filesystem::path file_;
  Records old_;
  Records new_;
  bool has_changed_ = false;
};

}  // namespace episcope::io
