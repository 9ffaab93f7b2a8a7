// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/durable/append_log.h"

#include "engine/core/error.h"
#include "engine/io/durable/system_error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <span>

namespace episcope::io {
namespace {

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

AppendLog::AppendLog(const std::filesystem::path& path) : path_(path) {
  errno = 0;
  file_ = FileDescriptor(path, O_RDWR | O_CREAT | O_APPEND);
  if (!file_.ok()) throw write_error(path);
  if (::flock(file_.id(), LOCK_EX | LOCK_NB) != 0) {
    throw IoError(path, "another program is writing it; wait for its end or name another folder");
  }
  read_lines();
}

void AppendLog::read_lines() {
  std::vector<std::uint8_t> bytes;
  if (!read_all(file_.id(), bytes)) {
    throw IoError(path_, std::string("cannot be read: ") + std::strerror(errno));
  }
  const std::string text(bytes.begin(), bytes.end());
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin)) {
    lines_.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  if (begin < text.size() && ::ftruncate(file_.id(), static_cast<off_t>(begin)) != 0) {
    throw write_error(path_);
  }
}

void AppendLog::append(const std::string& line) {
  const off_t size = ::lseek(file_.id(), 0, SEEK_END);
  errno = 0;
  if (size >= 0 && write_all(file_.id(), bytes_of(line + "\n")) && ::fsync(file_.id()) == 0) return;
  const IoError error = write_error(path_);
  // What cannot be taken back now is dropped when the log is opened again.
  [[maybe_unused]] const int ignored = size < 0 ? -1 : ::ftruncate(file_.id(), size);
  throw error;
}

}  // namespace episcope::io
