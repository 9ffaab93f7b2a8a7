// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/project_file.h"
#include "engine/io/base/append_log.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace episcope {

/// A folder of the program's own that holds what is open while it is worked on: a project file and
/// the results. It stays when the program is killed, and is then offered by the next one.
class Workspace {
 public:
  /// Makes a folder of its own in `root` and holds it. Throws IoError.
  explicit Workspace(const std::filesystem::path& root);
  /// Takes over one that was left. Throws IoError, also if a living program holds it.
  static std::unique_ptr<Workspace> take_over(const std::filesystem::path& folder);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::filesystem::path project_file() const;
  /// Removes the folder with all it holds; what cannot be removed stays.
  void remove();

 private:
  struct Existing {
    std::filesystem::path folder;
  };
  explicit Workspace(Existing existing);

  std::filesystem::path folder_;
  io::AppendLog lock_;
};

/// Workspace of a program that was killed.
struct OrphanedWorkspace {
  std::filesystem::path folder;
  Project project;
  std::filesystem::file_time_type last_change;
};

/// Workspaces in `root` that no living program holds, the latest first. Those without a readable
/// project are left out.
[[nodiscard]] std::vector<OrphanedWorkspace> orphaned_workspaces(const std::filesystem::path& root);

/// Removes a workspace that the user does not want or that was taken over.
void discard_workspace(const std::filesystem::path& folder);

}  // namespace episcope
