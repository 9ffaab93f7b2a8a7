// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/known_files.h"

#include "engine/core/text.h"

#include <algorithm>
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

/// Bytes of the character that begins with this one in UTF-8; 0 if none does.
std::size_t length_of_character(char first) {
  const auto code = static_cast<unsigned char>(first);
  if (is_ascii(first)) return 1;
  if (code >= 0xC2 && code < 0xE0) return 2;
  if (code >= 0xE0 && code < 0xF0) return 3;
  return code >= 0xF0 && code < 0xF5 ? 4 : 0;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = length_of_character(text.front());
    if (length == 0 || length > text.size()) return false;
    const std::string_view rest = text.substr(1, length - 1);
    if (!std::ranges::all_of(rest, continues_character)) return false;
    text.remove_prefix(length);
  }
  return true;
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

}  // namespace episcope
