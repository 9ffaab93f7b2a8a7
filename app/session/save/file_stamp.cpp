// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/save/file_stamp.h"

#include <system_error>

namespace episcope {

FileStamp stamp_of(const std::filesystem::path& path) {
  std::error_code failed;
  const auto bytes = std::filesystem::file_size(path, failed);
  if (failed) return {};
  const auto changed = std::filesystem::last_write_time(path, failed);
  return failed ? FileStamp{} : FileStamp{bytes, changed};
}

}  // namespace episcope
