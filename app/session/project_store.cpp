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
    for (const ProjectResult& result : scene.results) add(result.file);
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
  for (ProjectResult& result : scene.results) {
    const std::string stem = scene.name + "_" + result.name;
    if (!is_in_file(result)) result.file.clear();
    if (result.is_unread) {
      result.file = copied_unread(folder, result.file);
    } else if (result.file.empty()) {
      result.file = store_result(folder, scene.name, result, scene.input, progress);
    } else if (result.file.parent_path() != folder) {
      result.file = copied_into(folder, stem, result.file);
    }
    progress.check();
  }
  std::erase_if(scene.results, [](const ProjectResult& each) { return each.file.empty(); });
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

bool is_in_file(const ProjectResult& result) {
  return !result.file.empty() && (!result.estimate || io::is_there(result.file));
}

fs::path store_result(const fs::path& folder, const std::string& scene, const ProjectResult& result,
                      const std::string& input, const Progress& progress) {
  io::make_folder(folder);
  const fs::path file = unused_file(folder, file_name_of(scene + "_" + result.name), ".h5");
  save_result(file, *result.estimate, input, progress);
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

namespace {

ProjectResult result_of(const EstimateEntry& entry) {
  return {.name = entry.name,
          .file = entry.kept,
          .display_range = entry.display_range,
          .is_saved = entry.is_saved,
          .note = entry.note,
          .foreign_file = entry.foreign_file,
          .id = entry.id,
          .estimate = entry.estimate};
}

ProjectScene project_scene_of(const OpenScene& open) {
  ProjectScene scene{.name = open.name,
                     .input = open.input,
                     .sample_hash = open.sample_hash,
                     .reading = open.reading,
                     .place = open.place,
                     .id = open.id,
                     .results = {},
                     .strokes = open.unread_strokes,
                     .unread_strokes = open.unread_strokes,
                     .labels = open.labels};
  for (const EstimateEntry& entry : open.estimates) {
    ProjectResult result = result_of(entry);
    result.is_shown = entry.id == open.shown;
    const bool is_b = entry.id == open.compared;
    result.is_compared = is_b && open.is_compared_chosen;
    result.was_shown_before = is_b && !open.is_compared_chosen;
    scene.results.push_back(std::move(result));
  }
  for (const EstimateEntry& entry : open.unread) {
    if (entry.kept.empty()) continue;
    scene.results.push_back(result_of(entry));
    scene.results.back().is_unread = true;
  }
  return scene;
}

}  // namespace

Project project_of(const Session& session) {
  Project project;
  project.bad_threshold_px = session.bad_threshold_px();
  for (const OpenScene* each : session.scenes()) {
    if (each->id == session.generation()) project.current = project.scenes.size();
    project.scenes.push_back(project_scene_of(*each));
  }
  return project;
}

OpenScene scene_of(const ProjectScene& scene, bool is_saved) {
  OpenScene open;
  open.name = scene.name;
  open.input = scene.input;
  open.reading = scene.reading;
  open.sample_hash = scene.sample_hash;
  open.place = scene.place;
  open.labels = scene.labels;
  open.labels.is_saved = is_saved;
  int id = 0;
  for (const ProjectResult& result : scene.results) {
    open.estimates.push_back({.id = ++id,
                              .name = result.name,
                              .estimate = nullptr,
                              .display_range = result.display_range,
                              .is_saved = is_saved || result.is_saved,
                              .kept = result.file,
                              .note = result.note,
                              .foreign_file = result.foreign_file});
    if (result.is_shown) open.shown = id;
    if (result.is_compared || result.was_shown_before) open.compared = id;
    if (result.is_compared) open.is_compared_chosen = true;
  }
  return open;
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
