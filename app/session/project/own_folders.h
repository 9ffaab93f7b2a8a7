// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/document/annotation_journal.h"

#include <filesystem>

namespace episcope {

/// The folders in which a project keeps files: its own and those below, and the one of its files,
/// which may be a link to another disk.
class OwnFolders {
 public:
  explicit OwnFolders(const std::filesystem::path& project);

  /// Whether a file, given by its absolute path, is in one of them when links are followed: a link
  /// in the folder of a project could lead to any file of the user's.
  [[nodiscard]] bool contain(const std::filesystem::path& file) const;

 private:
  std::filesystem::path folder_;
  std::filesystem::path files_;
};

/// Where strokes of a project say that labels are saved (JournalOwner::file) would be written to:
/// empty afterwards if it is not in `own`, so that the user is asked.
void forget_file_elsewhere(JournalOwner& owner, const OwnFolders& own);

}  // namespace episcope
