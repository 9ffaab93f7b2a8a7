// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace episcope::io {

/// Records what happens to every file of a folder: readers note the files that they use, the others
/// are counted by kind. Ignores hidden files and the content of subfolders that were not added.
class FileUsage {
 public:
  /// Lists the files of `folder`. Throws filesystem_error.
  explicit FileUsage(const std::filesystem::path& folder);

  /// Adds the files of another folder or of a subfolder. Does nothing if there is no such folder.
  void add_folder(const std::filesystem::path& folder);

  /// Notes that a file was read as `kind`, a plural ("views", "labels"). The file may lie
  /// elsewhere. A second use of a file adds to the count of that kind.
  void use(const std::filesystem::path& file, const std::string& kind);
  void use(const std::vector<std::filesystem::path>& files, const std::string& kind);

  /// Notes files that were examined but not used, with the reason in `kind`: "depth maps, as no
  /// camera is known". Files that were used stay used.
  void leave_out(const std::vector<std::filesystem::path>& files, const std::string& kind);

  /// Lists kinds in the order of their first use, then the kinds left out, then the other files.
  /// Names that differ in numbers only form one kind ("depth_#.npy"). If that makes more than 20
  /// kinds, files are grouped by suffix ("*.npy"), or all together.
  [[nodiscard]] std::vector<FileUse> uses() const;

 private:
  std::vector<FileUse> used_;
  std::vector<FileUse> left_out_;
  std::map<std::filesystem::path, bool> files_;  ///< And whether they were noted.
};

}  // namespace episcope::io
