// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/project/own_folders.h"

#include "app/session/project/stored_project.h"
#include "engine/io/durable/leads_into.h"

namespace episcope {

namespace fs = std::filesystem;

OwnFolders::OwnFolders(const fs::path& project)
    : folder_(fs::absolute(project).lexically_normal().parent_path()),
      files_(files_of_project(project)) {}

bool OwnFolders::contain(const fs::path& file) const {
  const fs::path normal = file.lexically_normal();
  return io::leads_into(normal, folder_) || io::leads_into(normal, files_);
}

void forget_file_elsewhere(JournalOwner& owner, const OwnFolders& own) {
  if (!own.contain(owner.file)) owner.file.clear();
}

}  // namespace episcope
