// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/user_folders.h"

#include "engine/core/error.h"
#include "engine/core/memory.h"
#include "engine/io/formats/archive_reader.h"
#include "engine/io/formats/sequence_reader.h"
#include "engine/io/models/label_list.h"
#include "engine/io/models/scribble_file.h"

#include <unistd.h>
#include <cstdlib>
#include <system_error>

namespace episcope {
namespace {

std::filesystem::path user_folder(const char* variable, const char* below_home) {
  const char* named = std::getenv(variable);
  // The specification has relative paths ignored.
  if (named && std::filesystem::path(named).is_absolute()) {
    return std::filesystem::path(named) / "episcope";
  }
  const char* home = std::getenv("HOME");
  return home && *home ? std::filesystem::path(home) / below_home / "episcope"
                       : std::filesystem::path();
}

/// Whether a folder that need not exist yet could be made and written to.
bool can_be_written(std::filesystem::path folder) {
  std::error_code error;
  while (!folder.empty() && !std::filesystem::exists(folder, error)) {
    const std::filesystem::path above = folder.parent_path();
    if (above == folder) return false;
    folder = above;
  }
  return access(folder.c_str(), W_OK | X_OK) == 0;
}

}  // namespace

std::filesystem::path default_cache_folder() {
  return user_folder("XDG_CACHE_HOME", ".cache");
}

void use_cache_for_scratch() {
  const std::filesystem::path cache = default_cache_folder();
  if (!cache.empty() && can_be_written(cache)) set_scratch_folder(cache / "scratch");
}

std::filesystem::path default_state_folder() {
  return user_folder("XDG_STATE_HOME", ".local/state");
}

std::filesystem::path default_journal_folder() {
  const std::filesystem::path state = default_state_folder();
  return state.empty() ? state : state / "journals";
}

std::filesystem::path default_workspace_folder() {
  const std::filesystem::path state = default_state_folder();
  return state.empty() ? state : state / "sessions";
}

namespace fs = std::filesystem;

fs::path label_place(const LightField& light_field) {
  const fs::path source = light_field.info().source;
  std::error_code ignored;
  if (const fs::path frame = io::frame_path(light_field.info()); !frame.empty()) {
    return fs::is_directory(frame, ignored) ? frame / "labels.h5"
                                            : source / ("labels_" + frame.stem().string() + ".h5");
  }
  if (fs::is_directory(source, ignored)) return source / "labels.h5";
  if (!fs::is_regular_file(source, ignored)) return {};
  if (light_field.info().reading.reader == io::kArchiveReader) return io::labels_beside(source);
  // Several light fields of other forms may share a folder.
  const int frame = io::open_schema().parse(light_field.info().reading.options).frame;
  std::string stem = source.stem().string();
  if (frame > 0) stem.append("_").append(std::to_string(frame));  // one of several in the file
  return source.parent_path() / (stem + "_labels.h5");
}

bool is_writable(const fs::path& path) {
  // Files are replaced, so the folder decides too.
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (::access(folder.c_str(), W_OK | X_OK) != 0) return false;
  return ::access(path.c_str(), F_OK) != 0 || ::access(path.c_str(), W_OK) == 0;
}

void read_kept_scribbles(Scene& scene, const Progress& progress) {
  const fs::path place = label_place(*scene.light_field);
  std::error_code ignored;
  // Readers of the archive look there themselves.
  const LightFieldInfo& info = scene.light_field->info();
  const fs::path frame = io::frame_path(info);
  const bool is_known = info.reading.reader == io::kArchiveReader ||
                        (!frame.empty() && fs::exists(frame / "lf.h5", ignored));
  if (is_known || !fs::exists(place, ignored)) return;
  try {
    scene.scribbles = io::read_scribbles(place, scene, progress);
  } catch (const IoError& error) {
    scene.convention.warnings.push_back(std::string("Scribbles were not read: ") + error.what());
  }
}

}  // namespace episcope
