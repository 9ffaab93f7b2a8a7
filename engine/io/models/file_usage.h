// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace episcope::io {

/// What becomes of every file of a folder: a reader notes what it uses, the others are counted by
/// kind. Hidden files and what lies in folders inside are left aside, but for folders that were
/// noted.
class FolderAccount {
 public:
  /// Lists the files of `folder`. Throws filesystem_error.
  explicit FolderAccount(const std::filesystem::path& folder);

  /// Adds the files of another folder, or of one inside; nothing if there is no such folder.
  void add_folder(const std::filesystem::path& folder);

  /// Notes that a file was read as `kind`, a plural ("views", "labels"). A file that is not in the
  /// folders is noted likewise; a second use of a file adds a count of that kind.
  void use(const std::filesystem::path& file, const std::string& kind);
  void use(const std::vector<std::filesystem::path>& files, const std::string& kind);

  /// Notes files that were looked at but not used, with the reason in a kind: "depth maps, as no
  /// camera is known". Files that were used stay so.
  void leave_out(const std::vector<std::filesystem::path>& files, const std::string& kind);

  /// Used kinds in the order of their first use, then those left out, then other files not used:
  /// those that differ in numbers only are one kind ("depth_#.npy"). Where these would be more than
  /// 20, those with the same suffix are one ("*.npy"), or all.
  [[nodiscard]] std::vector<FileUse> uses() const;

 private:
  std::vector<FileUse> used_;
  std::vector<FileUse> left_out_;
  std::map<std::filesystem::path, bool> files_;  ///< And whether they were noted.
};

}  // namespace episcope::io
