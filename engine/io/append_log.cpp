// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/append_log.h"

#include "engine/core/error.h"
#include "engine/io/system_error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

namespace episcope::io {
namespace {

std::string read_all(int descriptor, const std::filesystem::path& path) {
  std::string text;
  std::array<char, 1 << 16> block{};
  for (;;) {
    const ssize_t count = ::read(descriptor, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw IoError(path, std::string("cannot be read: ") + std::strerror(errno));
    if (count == 0) return text;
    text.append(block.data(), static_cast<std::size_t>(count));
  }
}

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
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
  const std::string text = read_all(descriptor_, path_);
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
  if (size >= 0 && write_all(descriptor_, line + "\n") && ::fsync(descriptor_) == 0) return;
  const IoError error = write_error(path_);
  // What cannot be taken back now is dropped when the log is opened again.
  [[maybe_unused]] const int ignored = size < 0 ? -1 : ::ftruncate(descriptor_, size);
  throw error;
}

}  // namespace episcope::io
