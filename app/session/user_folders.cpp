// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/user_folders.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/memory.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/formats/archive_reader.h"
#include "engine/io/formats/sequence_reader.h"
#include "engine/io/models/scribble_file.h"

#include <fmt/format.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <system_error>

namespace episcope {

namespace {

namespace fs = std::filesystem;

// One file has one name here, however it was called.
fs::path name_of(const fs::path& file) {
  std::error_code failed;
  const fs::path name = fs::weakly_canonical(file, failed);
  return failed ? file : name;
}

}  // namespace

void KnownFiles::note(const fs::path& file, const FileStamp& stamp) {
  stamps_[name_of(file)] = stamp;
}

bool KnownFiles::has_changed(const fs::path& file) const {
  const auto known = stamps_.find(name_of(file));
  if (known == stamps_.end()) return false;
  const FileStamp now = stamp_of(file);
  return now != FileStamp{} && now != known->second;
}

FileStamp stamp_of(const std::filesystem::path& path) {
  std::error_code failed;
  const auto bytes = std::filesystem::file_size(path, failed);
  if (failed) return {};
  const auto changed = std::filesystem::last_write_time(path, failed);
  return failed ? FileStamp{} : FileStamp{bytes, changed};
}

namespace {

constexpr std::size_t kLongest = 80;
constexpr std::string_view kRefused = "/\\:*?\"<>|";

bool is_ascii(char c) {
  return static_cast<unsigned char>(c) < 0x80;
}

bool is_utf8(const std::string& text) {
  try {
    (void)nlohmann::json(text).dump();
    return true;
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

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
  while (!folder.empty() && !io::is_there(folder)) {
    const std::filesystem::path above = folder.parent_path();
    if (above == folder) return false;
    folder = above;
  }
  return access(folder.c_str(), W_OK | X_OK) == 0;
}

// What a session leaves for the next: `$XDG_STATE_HOME/episcope`, else `~/.local/state/episcope`;
// empty if neither is known.
std::filesystem::path default_state_folder() {
  return user_folder("XDG_STATE_HOME", ".local/state");
}

}  // namespace

std::string file_name_of(std::string name) {
  if (!is_utf8(name)) std::ranges::replace_if(name, std::not_fn(is_ascii), '_');
  std::ranges::replace_if(
      name, [](char each) { return kRefused.find(each) != std::string_view::npos; }, '_');
  if (name.size() <= kLongest) return name;
  std::size_t length = kLongest;
  while (continues_character(name[length])) --length;
  return name.substr(0, length);
}

std::filesystem::path default_cache_folder() {
  return user_folder("XDG_CACHE_HOME", ".cache");
}

void use_cache_for_scratch() {
  const std::filesystem::path cache = default_cache_folder();
  if (!cache.empty() && can_be_written(cache)) set_scratch_folder(cache / "scratch");
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
  if (const fs::path frame = io::frame_path(light_field.info()); !frame.empty()) {
    return io::is_folder(frame) ? frame / "labels.h5"
                                : source / ("labels_" + frame.stem().string() + ".h5");
  }
  if (io::is_folder(source)) return source / "labels.h5";
  if (!io::is_file(source)) return {};
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
  // Readers of the archive look there themselves.
  const LightFieldInfo& info = scene.light_field->info();
  const fs::path frame = io::frame_path(info);
  const bool is_known = info.reading.reader == io::kArchiveReader ||
                        (!frame.empty() && io::is_there(frame / "lf.h5"));
  if (is_known || !io::is_there(place)) return;
  try {
    scene.scribbles = io::read_scribbles(place, scene, progress);
  } catch (const IoError& error) {
    scene.convention.warnings.push_back(
        fmt::format(finding_text("scribbles.unread"), error.what()));
  }
}

}  // namespace episcope
