// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/folder_account.h"

#include <algorithm>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// A name with # for each of its numbers.
std::string kind_of(const std::string& name) {
  std::string kind;
  for (const char c : name) {
    const bool is_digit = c >= '0' && c <= '9';
    if (!is_digit) {
      kind += c;
    } else if (kind.empty() || kind.back() != '#') {
      kind += '#';
    }
  }
  return kind;
}

}  // namespace

FolderAccount::FolderAccount(const fs::path& folder) {
  add_folder(folder);
}

void FolderAccount::add_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (!is_hidden && entry.is_regular_file(error)) files_.try_emplace(entry.path(), false);
  }
}

void FolderAccount::use(const fs::path& file, const std::string& kind) {
  files_[file] = true;
  const auto found = std::ranges::find(used_, kind, &FileUse::kind);
  if (found == used_.end()) {
    used_.push_back({kind, 1, file.filename().string(), true});
  } else {
    ++found->count;
  }
}

void FolderAccount::use(const std::vector<fs::path>& files, const std::string& kind) {
  for (const fs::path& file : files) use(file, kind);
}

std::vector<FileUse> FolderAccount::uses() const {
  std::vector<FileUse> unused;
  for (const auto& [path, is_used] : files_) {
    if (is_used) continue;
    const std::string name = path.filename().string();
    const std::string kind = kind_of(name);
    const auto found = std::ranges::find(unused, kind, &FileUse::kind);
    if (found == unused.end()) {
      unused.push_back({kind, 1, name, false});
    } else {
      ++found->count;
    }
  }
  std::vector<FileUse> all = used_;
  all.insert(all.end(), unused.begin(), unused.end());
  return all;
}

}  // namespace episcope::io
