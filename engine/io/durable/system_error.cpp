// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/durable/system_error.h"

#include <fcntl.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>

namespace episcope::io {
namespace {

constexpr std::uintmax_t kNearlyNothing = 1 << 20;

// Pseudo file systems report no capacity at all.
bool is_disk_full(const std::filesystem::path& path) {
  std::error_code error;
  const auto space = std::filesystem::space(path.parent_path(), error);
  return !error && space.capacity > 0 && space.available < kNearlyNothing;
}

}  // namespace

void require_readable_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    throw IoError(path, "there is no such file; check the path");
  }
  if (std::filesystem::is_directory(status)) {
    throw IoError(path, "this is a folder where a file is needed; name a file in it");
  }
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    // Opening a pipe would wait for whoever writes into it.
    throw IoError(path, "this is neither a file nor a folder; choose another one");
  }
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    throw IoError(path, "the file cannot be opened (" + std::string(std::strerror(errno)) +
                            "); check its permissions");
  }
  ::close(descriptor);
}

IoError write_error(const std::filesystem::path& path) {
  const int code = errno;
  const bool is_forbidden = code == EACCES || code == EPERM || code == EROFS;
  if (code == EDQUOT) {
    return {path, "your quota of disk space is used up; remove files or choose another folder"};
  }
  if (code == EFBIG) {
    return {path, "the file would become larger than allowed here; choose another folder"};
  }
  if (code == ENOSPC || (!is_forbidden && is_disk_full(path))) {
    return {path, "the disk is full; free some space or choose another folder"};
  }
  if (code == ENOENT) {
    return {path, "the folder does not exist; create it or choose another one"};
  }
  if (code == ENOTDIR) {
    return {path, "part of this path is a file, not a folder; choose another path"};
  }
  const std::string reason = code == 0 ? "unknown reason" : std::strerror(code);
  return {path, "the file cannot be written (" + reason + "); choose another folder"};
}

}  // namespace episcope::io
