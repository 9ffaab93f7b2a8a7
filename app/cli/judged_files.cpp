// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/judged_files.h"

#include "app/cli/arguments.h"
#include "app/session/result_files.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/models/external_result.h"
#include "engine/io/models/reader.h"

#include <algorithm>
#include <filesystem>

namespace episcope::cli {
namespace {

namespace fs = std::filesystem;

bool is_submission(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(io::submitted_map_file(path, "").parent_path(), ignored);
}

/// A damaged file counts: judging it says what is wrong.
bool may_be_result(const fs::path& path) {
  try {
    return names_result(path.string());
  } catch (const IoError&) {
    return true;
  }
}

/// Results in and below a folder, by name.
std::vector<std::string> results_below(const fs::path& folder) {
  std::vector<std::string> found;
  constexpr auto options = fs::directory_options::skip_permission_denied;
  std::error_code ignored;
  for (const auto& entry : fs::recursive_directory_iterator(folder, options, ignored)) {
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (is_hidden || !entry.is_regular_file() || !map_form_of(entry.path())) continue;
    if (may_be_result(entry.path())) found.push_back(entry.path().string());
  }
  std::ranges::sort(found);
  if (found.empty()) throw IoError(folder, "there is no result in this folder; name another");
  return found;
}

std::vector<std::string> expanded(const std::vector<std::string>& results) {
  std::vector<std::string> files;
  std::error_code ignored;
  for (const std::string& one : results) {
    if (fs::is_directory(one, ignored) && !is_submission(one)) {
      std::ranges::move(results_below(one), std::back_inserter(files));
    } else {
      files.push_back(one);
    }
  }
  return files;
}

/// The light field that a result names; empty for a damaged file, since judging it says what is
/// wrong.
std::string known_source_of(const std::string& result) {
  try {
    return stated_source(result);
  } catch (const IoError&) {
    return {};
  }
}

JudgedFile by_own_source(const std::string& result) {
  std::error_code ignored;
  if (!fs::exists(result, ignored)) {
    throw IoError(result, "there is no such file or folder; check the path");
  }
  const std::string source = stated_source(result);
  if (source.empty()) {
    throw UsageError("evaluate: " + result +
                     " does not tell its light field; name it with --truth INPUT");
  }
  const std::string input = existing_source(source, result);
  if (!input.empty()) return {result, input, true};
  throw IoError(result,
                "its light field, " + source + ", is not there; name it with --truth INPUT");
}

/// One of several, which does not stop the others.
JudgedFile by_own_source_of_several(const std::string& result) {
  try {
    return by_own_source(result);
  } catch (const IoError& error) {
    return {.result = result, .truth = {}, .problem = error.what()};
  }
}

/// How many letters of its name a result shares with a scene: all of that, followed by an end or a
/// further word ("cotton" of cotton_epi_l.h5); 0 for another one.
std::size_t shared_letters(const fs::path& result, const std::string& scene) {
  const std::string name = lower_case(result.stem().string());
  const std::string wanted = lower_case(scene);
  if (lower_case(result.parent_path().filename().string()) == wanted) return wanted.size();
  if (!name.starts_with(wanted)) return 0;
  const bool ends = name.size() == wanted.size() || name[wanted.size()] == '_' ||
                    name[wanted.size()] == '-' || name[wanted.size()] == '.';
  return ends ? wanted.size() : 0;
}

const SceneInput* scene_of(const std::string& result, const std::vector<SceneInput>& scenes) {
  const std::string source = existing_source(known_source_of(result), result);
  for (const SceneInput& scene : scenes) {
    if (!source.empty() && is_same_input(source, scene.input)) return &scene;
  }
  const auto letters = [&result](const SceneInput& scene) {
    return shared_letters(result, scene.name);
  };
  const auto best = std::ranges::max_element(scenes, {}, letters);
  return best != scenes.end() && letters(*best) > 0 ? &*best : nullptr;
}

std::vector<JudgedFile> matched(const std::vector<std::string>& results,
                                const std::vector<SceneInput>& scenes, Job& job) {
  std::vector<JudgedFile> files;
  std::vector<bool> is_used(results.size(), false);
  for (const SceneInput& scene : scenes) {
    for (std::size_t i = 0; i < results.size(); ++i) {
      const std::string& result = results[i];
      const bool is_of_scene =
          is_submission(result)
              ? fs::exists(io::submitted_map_file(result, io::scene_name(scene.input)))
              : scene_of(result, scenes) == &scene;
      if (!is_of_scene) continue;
      files.push_back({result, scene.input});
      is_used[i] = true;
    }
  }
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!is_used[i]) job.note(results[i] + ": no light field has its name; it is left out");
  }
  return files;
}

}  // namespace

std::vector<JudgedFile> judged_files(const std::vector<std::string>& results,
                                     const std::string& truth, const ReadOptions& options,
                                     Job& job) {
  const std::vector<std::string> files = expanded(results);
  std::vector<JudgedFile> judged;
  if (truth.empty()) {
    if (files.size() == 1) return {by_own_source(files.front())};
    std::ranges::transform(files, std::back_inserter(judged), by_own_source_of_several);
    std::ranges::stable_sort(judged, {}, &JudgedFile::truth);
    return judged;
  }
  check_input(truth);
  const Progress progress = job.progress().part(0, 0);
  if (is_collection(truth, options, progress)) {
    judged = matched(files, scene_inputs({truth}, options, Frames::One, progress), job);
    if (judged.empty()) {
      throw IoError(truth,
                    "no light field in this folder has the name of a result; name one that "
                    "has");
    }
    return judged;
  }
  for (const std::string& file : files) judged.push_back({file, truth});
  return judged;
}

}  // namespace episcope::cli
