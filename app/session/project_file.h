// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/annotation_journal.h"
#include "app/session/open_scene.h"
#include "app/session/sweep.h"
#include "engine/evaluation/metrics.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace episcope {

/// A light field of a project with what was found and drawn on it. Of one that was read, ids count
/// from 1, and files hold everything.
struct ProjectScene : OpenScene {
  std::filesystem::path strokes{};  ///< Journal of what was painted; empty = nothing was.
};

/// Contents of a project file.
struct Project {
  std::vector<ProjectScene> scenes;
  std::size_t current = 0;  ///< The one that is shown.
  double bad_threshold_px = kBadPixelThreshold_px;
  std::vector<Sweep> sweeps{};     ///< Their scenes are named by their ids.
  std::filesystem::path saved_as;  ///< Of a workspace: the user's own file of it; empty = none yet.
};

inline constexpr const char* kProjectSuffix = ".episcope";

/// Whether a path is named like a project file.
[[nodiscard]] bool names_project(const std::filesystem::path& path);

/// Writes a project file, JSON. Paths in it are relative to its folder wherever they share more
/// than the root, so that all can move together. Every result must have a file. Atomic. Throws
/// IoError.
void write_project(const std::filesystem::path& path, const Project& project);

/// Where results, strokes and labels of a project may be.
enum class ProjectFiles {
  Beside,   ///< Below the folder of the project: a project of the user's.
  Anywhere  ///< A workspace, which names files of the project that it continues.
};

/// Reads a project file; paths come back absolute. Whether the files are there is not looked at.
/// Light fields and meshes may be anywhere. Other files are copied when the project is saved; so a
/// project from elsewhere must not name files of the reader. Throws IoError with one sentence, also
/// for a file that is not where `files` says.
[[nodiscard]] Project read_project(const std::filesystem::path& path,
                                   ProjectFiles files = ProjectFiles::Beside);

/// The user's work on a scene (has_work) as a text, which changes whenever the work does. Poses
/// count as what they are computed from.
[[nodiscard]] std::string work_text(const ScenePlace& place);

/// The folder beside a project file that holds its results and strokes: "name_files".
[[nodiscard]] std::filesystem::path files_of_project(const std::filesystem::path& project);

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

/// Clears JournalOwner::file, the place to which labels are saved, unless it is in `own`: the user
/// is asked then.
void forget_file_elsewhere(JournalOwner& owner, const OwnFolders& own);

}  // namespace episcope
