// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace episcope {

/// The folders in which a project keeps files: its own and those below, and the one of its files,
/// which may be a link to another disk.
class OwnFolders {
 public:
  explicit OwnFolders(const std::filesystem::path& project);

  /// `file`: absolute, without dots.
  [[nodiscard]] bool contain(const std::filesystem::path& file) const;

 private:
  std::filesystem::path folder_;
  std::filesystem::path files_;  ///< As it is when links are followed.
};

}  // namespace episcope
