// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/project/own_folders.h"

#include "app/session/project/stored_project.h"

#include <algorithm>

namespace episcope {
namespace {

namespace fs = std::filesystem;

bool is_below(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first ==
         folder.end();
}

}  // namespace

OwnFolders::OwnFolders(const fs::path& project) {
  std::error_code error;
  folder_ = fs::weakly_canonical(fs::absolute(project).lexically_normal().parent_path(), error);
  files_ = fs::weakly_canonical(files_of_project(project), error);
}

bool OwnFolders::contain(const fs::path& file) const {
  std::error_code error;
  const fs::path followed = fs::weakly_canonical(file.lexically_normal(), error);
  if (error) return false;
  return is_below(followed, folder_) || (!files_.empty() && is_below(followed, files_));
}

void forget_file_elsewhere(JournalOwner& owner, const OwnFolders& own) {
  if (!own.contain(owner.file)) owner.file.clear();
}

}  // namespace episcope
