// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/project_file.h"
#include "app/session/session.h"
#include "engine/core/progress.h"
#include "engine/io/base/atomic_file.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace episcope {

/// Whether its file holds a result: one that is in memory may have lost its file.
[[nodiscard]] bool is_in_file(const EstimateEntry& result);

/// Writes a result that is in memory to a file of `folder` that no other has, named after it.
/// Atomic. Returns the file. Throws IoError, Cancelled.
[[nodiscard]] std::filesystem::path store_result(const std::filesystem::path& folder,
                                                 const ProjectScene& scene,
                                                 const EstimateEntry& result,
                                                 const Progress& progress);
/// Writes the labels of a scene in the same way.
[[nodiscard]] std::filesystem::path store_labels(const std::filesystem::path& folder,
                                                 const ProjectScene& scene,
                                                 const Progress& progress);

/// Writes a project file with all that it names beside it: results, labels and strokes that lie
/// elsewhere are copied. The old file stays until everything is there; then what only the old one
/// named is removed. Returns the project with the places of its files. Throws IoError, Cancelled.
[[nodiscard]] Project store_project(const std::filesystem::path& path, Project project,
                                    const Progress& progress);

/// The project that the open scenes make, without strokes. Results are held, not copied.
[[nodiscard]] Project project_of(const Session& session);

/// A scene of a project, on disk only. `is_saved`: the project is a file of the user's.
[[nodiscard]] OpenScene scene_of(OpenScene scene, bool is_saved);

/// Where a folder was and where it is now.
struct MovedFolder {
  std::filesystem::path from;
  std::filesystem::path to;
};

/// The outermost folders by which two paths of the same light field differ.
[[nodiscard]] MovedFolder moved_folder(const std::filesystem::path& from,
                                       const std::filesystem::path& to);

/// Where an input is after its folder was moved, if it is not where it was and is there; else
/// empty.
[[nodiscard]] std::string moved_input(const std::string& input, const MovedFolder& moved);

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
