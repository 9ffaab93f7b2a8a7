// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/durable/atomic_folder.h"

#include "engine/core/error.h"
#include "engine/io/durable/atomic_file.h"
#include "engine/io/durable/system_error.h"
#include "engine/io/durable/temporary_name.h"

#include <cerrno>
#include <cstdio>

namespace episcope::io {

namespace fs = std::filesystem;

AtomicFolder::AtomicFolder(const fs::path& target, std::uintmax_t bytes) : target_(target) {
  std::error_code error;
  if (!target_.has_filename()) target_ = target_.parent_path();
  if (fs::exists(target_, error) && !fs::is_directory(target_, error)) {
    throw IoError(target, "this is a file; name a new folder");
  }
  if (fs::is_directory(target_, error) && !fs::is_empty(target_, error)) {
    throw IoError(target, "the folder holds other files; name a new or an empty folder");
  }
  const fs::path parent = folder_of(target_);
  remove_abandoned(target_);
  require_space(target, parent, bytes);
  temporary_ = parent / temporary_name(target_);
  errno = 0;
  if (!fs::create_directory(temporary_, error)) {
    errno = error.value();
    temporary_.clear();
    throw write_error(target);
  }
}

AtomicFolder::~AtomicFolder() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

void AtomicFolder::commit() {
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) throw write_error(target_);
  temporary_.clear();
}

}  // namespace episcope::io
