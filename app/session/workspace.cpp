// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/workspace.h"

#include "app/session/project_file.h"
#include "engine/core/error.h"
#include "engine/io/base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <random>

namespace episcope {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLock = "lock";

fs::path project_in(const fs::path& folder) {
  return folder / (std::string("session") + kProjectSuffix);
}

fs::path new_folder(const fs::path& root) {
  std::random_device random;
  fs::path folder = root / fmt::format("{:08x}", random());
  io::make_folder(folder,
                  ", so results could not be recovered after a crash; create it or make its parent "
                  "writable");
  return folder;
}

}  // namespace

Workspace::Workspace(const fs::path& root) : Workspace(Existing{new_folder(root)}) {}

Workspace::Workspace(Existing existing)
    : folder_(std::move(existing.folder)),
      lock_(folder_ / kLock, io::LogFraming::Lines, io::LogFlush::AtOnce) {}

std::unique_ptr<Workspace> Workspace::take_over(const fs::path& folder) {
  return std::unique_ptr<Workspace>(new Workspace(Existing{folder}));
}

fs::path Workspace::project_file() const {
  return project_in(folder_);
}

void Workspace::remove() {
  discard_workspace(folder_);
}

std::vector<OrphanedWorkspace> orphaned_workspaces(const fs::path& root) {
  std::vector<OrphanedWorkspace> left;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(root, ignored)) {
    const fs::path& folder = entry.path();
    if (!entry.is_directory(ignored) || io::is_held(folder / kLock)) continue;
    const fs::path file = project_in(folder);
    try {
      left.push_back(
          {folder, read_project(file, ProjectFiles::Anywhere), fs::last_write_time(file, ignored)});
    } catch (const IoError&) {
      // Killed before anything was in it, or not to be read: nothing can be offered.
    }
  }
  std::ranges::sort(left, std::greater{}, &OrphanedWorkspace::last_change);
  return left;
}

void discard_workspace(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder, ignored);
}

}  // namespace episcope
