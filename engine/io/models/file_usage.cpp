// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/file_usage.h"

#include "engine/core/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostUnusedKinds =
    20;  ///< Of files not used; more are told apart less finely.

/// A name with # for each of its numbers, except in a suffix such as .h5.
std::string kind_by_numbers(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  const bool has_suffix = dot != name.npos && dot + 1 < name.size() && !is_digit(name[dot + 1]);
  const std::size_t end = has_suffix ? dot : name.size();
  std::string kind;
  for (const char c : name.substr(0, end)) {
    if (!is_digit(c)) {
      kind += c;
    } else if (kind.empty() || kind.back() != '#') {
      kind += '#';
    }
  }
  return kind + name.substr(end);
}

/// "*.txt".
std::string kind_by_suffix(const std::string& name) {
  return fmt::format("*{}", suffix_of(name));
}

std::string kind_of_others(const std::string&) {
  return "*";
}

/// In the order of the first file of each kind.
std::vector<FileUse> count_unused(const std::vector<std::string>& names,
                                  std::string (*kind_of)(const std::string&)) {
  std::vector<FileUse> kinds;
  std::unordered_map<std::string, std::size_t> places;
  for (const std::string& name : names) {
    const std::string kind = kind_of(name);
    const auto [place, is_new] = places.try_emplace(kind, kinds.size());
    if (is_new) kinds.push_back({kind, 0, name, false});
    ++kinds[place->second].count;
  }
  return kinds;
}

/// One key for all ways to write a path.
fs::path key_of(const fs::path& path) {
  return fs::absolute(path).lexically_normal();
}

void count_one(std::vector<FileUse>& uses, FileUse one) {
  const auto found = std::ranges::find(uses, one.kind, &FileUse::kind);
  if (found == uses.end()) {
    uses.push_back(std::move(one));
  } else {
    ++found->count;
  }
}

}  // namespace

FileUsage::FileUsage(const fs::path& folder) {
  add_folder(folder);
}

void FileUsage::add_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (!is_hidden && entry.is_regular_file(error)) files_.try_emplace(key_of(entry.path()), false);
  }
}

void FileUsage::use(const fs::path& file, const std::string& kind) {
  files_[key_of(file)] = true;
  count_one(used_, {kind, 1, file.filename().string(), true});
}

void FileUsage::use(const std::vector<fs::path>& files, const std::string& kind) {
  for (const fs::path& file : files) use(file, kind);
}

void FileUsage::leave_out(const std::vector<fs::path>& files, const std::string& kind) {
  for (const fs::path& file : files) {
    bool& is_noted = files_[key_of(file)];
    if (!is_noted) count_one(left_out_, {kind, 1, file.filename().string(), false});
    is_noted = true;
  }
}

std::vector<FileUse> FileUsage::uses() const {
  std::vector<std::string> unused;
  for (const auto& [path, is_noted] : files_) {
    if (!is_noted) unused.push_back(path.filename().string());
  }
  std::vector<FileUse> all = used_;
  all.insert(all.end(), left_out_.begin(), left_out_.end());
  for (const auto& kind_of : {kind_by_numbers, kind_by_suffix, kind_of_others}) {
    const std::vector<FileUse> kinds = count_unused(unused, kind_of);
    if (kinds.size() > kMostUnusedKinds) continue;
    all.insert(all.end(), kinds.begin(), kinds.end());
    break;
  }
  return all;
}

}  // namespace episcope::io
