// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/save/known_files.h"

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

}  // namespace episcope
