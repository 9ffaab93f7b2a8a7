// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/durable/atomic_file.h"

#include "engine/core/error.h"
#include "engine/io/durable/file_descriptor.h"
#include "engine/io/durable/system_error.h"
#include "engine/io/durable/temporary_name.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <string>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

fs::path resolve_link(const fs::path& named) {
  std::error_code error;
  if (!fs::is_symlink(named, error)) return named;
  const fs::path target = fs::weakly_canonical(named, error);
  return error ? named : target;
}

bool flush_to_disk(const fs::path& path, int flags) {
  const FileDescriptor file(path, flags);
  return file.ok() && ::fsync(file.id()) == 0;
}

constexpr double kMebibyte = 1 << 20;

}  // namespace

void require_space(const fs::path& target, const fs::path& folder, std::uintmax_t bytes) {
  std::error_code error;
  const auto space = fs::space(folder, error);
  // Pseudo file systems report no capacity at all; there the write itself has to tell.
  if (error || space.capacity == 0 || space.available >= bytes) return;
  throw IoError(target, fmt::format("the disk is full: {:.1f} MiB are needed and {:.1f} MiB are "
                                    "free; free some space or choose another folder",
                                    static_cast<double>(bytes) / kMebibyte,
                                    static_cast<double>(space.available) / kMebibyte));
}

AtomicFile::AtomicFile(const fs::path& target, std::uintmax_t bytes)
    : named_(target), target_(resolve_link(target)) {
  std::error_code error;
  const auto status = fs::status(target_, error);
  if (target_.filename().empty() || fs::is_directory(status)) {
    throw IoError(named_, "this is a folder; name a file in it");
  }
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw IoError(named_, "this is not a regular file and is not overwritten; choose another name");
  }
  remove_abandoned(target_);
  require_space(named_, folder_of(target_), bytes);
  temporary_ = folder_of(target_) / temporary_name(target_);
  errno = 0;
  const FileDescriptor file(temporary_, O_CREAT | O_EXCL | O_WRONLY);
  if (!file.ok()) {
    temporary_.clear();
    throw write_error(named_);
  }
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  errno = 0;
  if (!flush_to_disk(temporary_, O_RDONLY)) throw write_error(named_);
  commit_unflushed();
  // The file is whole by now; a folder that cannot be flushed only risks the name after a crash.
  flush_folder(target_);
}

void AtomicFile::commit_unflushed() {
  errno = 0;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) throw write_error(named_);
  temporary_.clear();
}

void flush_folder(const fs::path& target) {
  flush_to_disk(folder_of(target), O_RDONLY | O_DIRECTORY);
}

void write_atomically(const fs::path& target, std::span<const std::uint8_t> bytes) {
  AtomicFile file(target, bytes.size());
  {
    const FileDescriptor out(file.temporary(), O_WRONLY);
    if (!out.ok()) throw write_error(target);
    if (!write_all(out.id(), bytes)) throw write_error(target);
  }
  file.commit();
}

void write_atomically(const std::filesystem::path& target, std::string_view text) {
  write_atomically(target,
                   std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace episcope::io
