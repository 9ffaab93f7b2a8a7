// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/project_store.h"

#include "app/session/load_scene.h"
#include "app/session/result_files.h"
#include "app/session/user_folders.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <random>
#include <set>

namespace episcope {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStrokes = ".strokes";

fs::path unused_file(const fs::path& folder, const std::string& stem, const std::string& suffix) {
  const auto is_taken = [&](const std::string& name) {
    return fs::exists(folder / (name + suffix));
  };
  return folder / (unique_name(stem, "_", is_taken) + suffix);
}

void copy_to(const fs::path& from, const fs::path& to) {
  io::AtomicFile file(to);
  std::error_code error;
  fs::copy_file(from, file.temporary(), fs::copy_options::overwrite_existing, error);
  if (error)
    throw IoError(from, "cannot be copied to " + to.string() + " (" + error.message() + ")");
  file.commit();
}

// All files beside the project that it names.
std::set<fs::path> files_in(const Project& project, const fs::path& folder) {
  std::set<fs::path> files;
  const auto add = [&](const fs::path& file) {
    if (file.parent_path() == folder) files.insert(file);
  };
  for (const ProjectScene& scene : project.scenes) {
    add(scene.strokes);
    add(scene.unread_strokes);
    add(scene.labels.file);
    for (const EstimateEntry& result : scene.estimates) add(result.kept);
    for (const EstimateEntry& result : scene.unread) add(result.kept);
  }
  return files;
}

std::set<fs::path> files_of_former(const fs::path& path, const fs::path& folder) {
  try {
    if (fs::exists(path)) return files_in(read_project(path), folder);
  } catch (const IoError&) {
    // What it named is not known: it stays.
  }
  return {};
}

fs::path copied_into(const fs::path& folder, const std::string& stem, const fs::path& file) {
  const fs::path target = unused_file(folder, file_name_of(stem), file.extension());
  copy_to(file, target);
  return target;
}

// Of what could not be read, another folder may be unable to have even a copy.
fs::path copied_unread(const fs::path& folder, const fs::path& file) {
  if (file.empty() || file.parent_path() == folder) return file;
  try {
    return copied_into(folder, file.stem(), file);
  } catch (const IoError&) {
    return {};
  }
}

void store_results(ProjectScene& scene, const fs::path& folder, const Progress& progress) {
  for (EstimateEntry& result : scene.estimates) {
    if (!is_in_file(result)) {
      result.kept = store_result(folder, scene, result, progress);
    } else if (result.kept.parent_path() != folder) {
      result.kept = copied_into(folder, scene.name + "_" + result.name, result.kept);
    }
    progress.check();
  }
  for (EstimateEntry& result : scene.unread) result.kept = copied_unread(folder, result.kept);
  std::erase_if(scene.unread, [](const EstimateEntry& each) { return each.kept.empty(); });
}

void store_scene_labels(ProjectScene& scene, const fs::path& folder, const Progress& progress) {
  KeptLabels& labels = scene.labels;
  if (labels.empty() || labels.file.parent_path() == folder) return;
  if (labels.labeling) {
    labels.file = store_labels(folder, scene, progress);
    return;
  }
  labels.file = copied_into(folder, scene.name + "_labels", labels.file);
}

// What was painted may have gone on since it was stored last: always a new file.
void store_strokes(ProjectScene& scene, const fs::path& folder) {
  const bool is_unread = scene.strokes == scene.unread_strokes;
  scene.unread_strokes = copied_unread(folder, scene.unread_strokes);
  if (is_unread) scene.strokes = scene.unread_strokes;
  if (is_unread || scene.strokes.empty()) return;
  const fs::path target = unused_file(folder, file_name_of(scene.name), kStrokes);
  copy_to(scene.strokes, target);
  scene.strokes = target;
}

}  // namespace

bool is_in_file(const EstimateEntry& result) {
  return !result.kept.empty() && (!result.estimate || io::is_there(result.kept));
}

fs::path store_result(const fs::path& folder, const ProjectScene& scene,
                      const EstimateEntry& result, const Progress& progress) {
  io::make_folder(folder);
  const fs::path file = unused_file(folder, file_name_of(scene.name + "_" + result.name), ".h5");
  save_result(file, *result.estimate, scene.input, progress);
  return file;
}

fs::path store_labels(const fs::path& folder, const ProjectScene& scene, const Progress& progress) {
  io::make_folder(folder);
  const fs::path file = unused_file(folder, file_name_of(scene.name + "_labels"), ".h5");
  write_kept_labels(file, scene.labels, scene.input, progress);
  return file;
}

Project store_project(const fs::path& path, Project project, const Progress& progress) {
  const fs::path folder = files_of_project(path);
  const std::set<fs::path> former = files_of_former(path, folder);
  io::make_folder(folder);
  double done = 0;
  for (ProjectScene& scene : project.scenes) {
    const double next = done + 1.0 / static_cast<double>(project.scenes.size());
    store_results(scene, folder, progress.part(done, std::min(next, 1.0)));
    store_strokes(scene, folder);
    store_scene_labels(scene, folder, progress.part(done, std::min(next, 1.0)));
    done = std::min(next, 1.0);
  }
  write_project(path, project);
  const std::set<fs::path> now = files_in(project, folder);
  for (const fs::path& each : former) {
    std::error_code ignored;
    if (!now.contains(each)) fs::remove(each, ignored);
  }
  return project;
}

Project project_of(const Session& session) {
  Project project;
  project.bad_threshold_px = session.bad_threshold_px();
  for (const OpenScene* each : session.scenes()) {
    if (each->id == session.generation()) project.current = project.scenes.size();
    ProjectScene& scene = project.scenes.emplace_back(ProjectScene{*each, each->unread_strokes});
    scene.scene.reset();
    scene.true_labels.reset();
    scene.label_disparity.reset();
    std::erase_if(scene.unread, [](const EstimateEntry& entry) { return entry.kept.empty(); });
  }
  return project;
}

OpenScene scene_of(OpenScene scene, bool is_saved) {
  scene.labels.is_saved = is_saved;
  for (EstimateEntry& result : scene.estimates) result.is_saved = is_saved || result.is_saved;
  return scene;
}

MovedFolder moved_folder(const fs::path& from, const fs::path& to) {
  fs::path before = from;
  fs::path after = to;
  while (before.has_relative_path() && after.has_relative_path() &&
         before.filename() == after.filename()) {
    before = before.parent_path();
    after = after.parent_path();
  }
  return {before, after};
}

std::string moved_input(const std::string& input, const MovedFolder& moved) {
  if (!builtin_scene_id(input).empty() || io::is_there(input)) return {};
  const fs::path path = input;
  const auto [end, rest] =
      std::mismatch(moved.from.begin(), moved.from.end(), path.begin(), path.end());
  if (end != moved.from.end()) return {};
  fs::path found = moved.to;
  for (auto part = rest; part != path.end(); ++part) found /= *part;
  return io::is_there(found) ? found.string() : std::string();
}

namespace {

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
