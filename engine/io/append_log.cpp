// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/append_log.h"

#include "engine/core/error.h"
#include "engine/io/file_descriptor.h"
#include "engine/io/system_error.h"

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
  descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw write_error(path);
  try {
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      throw IoError(path, "another program is writing it; wait for its end or name another folder");
    }
    read_lines();
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

AppendLog::~AppendLog() {
  ::close(descriptor_);
}

void AppendLog::read_lines() {
  std::vector<std::uint8_t> bytes;
  if (!read_all(descriptor_, bytes)) {
    throw IoError(path_, std::string("cannot be read: ") + std::strerror(errno));
  }
  const std::string text(bytes.begin(), bytes.end());
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin)) {
    lines_.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  if (begin < text.size() && ::ftruncate(descriptor_, static_cast<off_t>(begin)) != 0) {
    throw write_error(path_);
  }
}

void AppendLog::append(const std::string& line) {
  const off_t size = ::lseek(descriptor_, 0, SEEK_END);
  errno = 0;
  if (size >= 0 && write_all(descriptor_, bytes_of(line + "\n")) && ::fsync(descriptor_) == 0)
    return;
  const IoError error = write_error(path_);
  // What cannot be taken back now is dropped when the log is opened again.
  [[maybe_unused]] const int ignored = size < 0 ? -1 : ::ftruncate(descriptor_, size);
  throw error;
}

}  // namespace episcope::io
