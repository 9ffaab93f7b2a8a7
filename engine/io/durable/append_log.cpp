// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/durable/append_log.h"

#include "engine/core/error.h"
#include "engine/io/durable/atomic_file.h"
#include "engine/io/durable/system_error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

namespace episcope::io {
namespace {

using Bytes = std::vector<std::uint8_t>;

bool lock(const FileDescriptor& file) {
  return ::flock(file.id(), LOCK_EX | LOCK_NB) == 0;
}

IoError not_a_log(const std::filesystem::path& path) {
  return {path, "this is not a log of this program; choose another file"};
}

}  // namespace

AppendLog::AppendLog(const std::filesystem::path& path, LogFraming framing, LogFlush flush)
    : path_(path), framing_(framing) {
  errno = 0;
  file_ = FileDescriptor(path, O_RDWR | O_CREAT | O_APPEND);
  if (!file_.ok()) throw write_error(path);
  if (!lock(file_)) {
    throw IoError(
        path, "another program is writing it; wait until it has finished or name another folder");
  }
  read_records();
  start_flush(flush, BackgroundFlush::Start::Unflushed);
}

AppendLog::AppendLog(const std::filesystem::path& path, LogFraming framing, LogFlush flush,
                     std::span<const LogRecord> records)
    : path_(path), framing_(framing) {
  const auto signature = log_signature(framing);
  Bytes bytes(signature.begin(), signature.end());
  for (const LogRecord& record : records) put_record(framing, record, bytes);
  AtomicFile target(path, bytes.size());
  errno = 0;
  file_ = FileDescriptor(target.temporary(), O_WRONLY | O_APPEND);
  // Held before it has its name: nobody can take it for one that was left.
  if (!file_.ok() || !lock(file_) || !write_all(file_.id(), bytes)) throw write_error(path);
  bytes_ = bytes.size();
  std::error_code ignored;
  if (flush == LogFlush::AtOnce || std::filesystem::exists(path, ignored)) {
    target.commit();  // a loss of power must not cost the records that are there
    start_flush(flush, BackgroundFlush::Start::Flushed);
  } else {
    target.commit_unflushed();
    start_flush(flush, BackgroundFlush::Start::Unflushed);
  }
}

void AppendLog::start_flush(LogFlush flush, BackgroundFlush::Start start) {
  if (flush == LogFlush::InBackground) flush_.emplace(file_.id(), path_, start);
}

void AppendLog::read_records() {
  Bytes bytes;
  if (!read_all(file_.id(), bytes)) {
    throw IoError(path_, std::string("cannot be read: ") + std::strerror(errno));
  }
  const auto signature = log_signature(framing_);
  errno = 0;
  if (bytes.size() < signature.size() && std::ranges::equal(bytes, signature.first(bytes.size()))) {
    // New, or its program ended as it began to write.
    if (!write_all(file_.id(), signature.subspan(bytes.size()))) throw write_error(path_);
    bytes_ = signature.size();
    return;
  }
  auto content = parse_log(framing_, bytes);
  if (!content) throw not_a_log(path_);
  records_ = std::move(content->records);
  bytes_ = content->whole_bytes;
  if (bytes_ < bytes.size() && ::ftruncate(file_.id(), static_cast<off_t>(bytes_)) != 0) {
    throw write_error(path_);
  }
}

void AppendLog::append(std::span<const std::uint8_t> record) {
  Bytes bytes;
  put_record(framing_, record, bytes);
  write(bytes);
}

void AppendLog::append(std::string_view record) {
  append({reinterpret_cast<const std::uint8_t*>(record.data()), record.size()});
}

void AppendLog::append_all(std::span<const LogRecord> records) {
  Bytes bytes;
  for (const LogRecord& record : records) put_record(framing_, record, bytes);
  if (!bytes.empty()) write(bytes);
}

void AppendLog::write(std::span<const std::uint8_t> bytes) {
  require_sound();
  errno = 0;
  if (!write_all(file_.id(), bytes) || (!flush_ && ::fsync(file_.id()) != 0)) {
    const IoError error = write_error(path_);
    is_broken_ = ::ftruncate(file_.id(), static_cast<off_t>(bytes_)) != 0;
    throw error;
  }
  bytes_ += bytes.size();
  if (flush_) flush_->request();
}

void AppendLog::flush() {
  if (flush_) flush_->wait();
  require_sound();
}

void AppendLog::require_sound() {
  const int error = flush_ ? flush_->error() : 0;
  if (error == 0 && !is_broken_) return;
  errno = error;
  throw write_error(path_);
}

std::vector<LogRecord> read_log(const std::filesystem::path& path, LogFraming framing) {
  require_readable_file(path);
  const FileDescriptor file(path, O_RDONLY);
  Bytes bytes;
  if (!file.ok() || !read_all(file.id(), bytes)) {
    throw IoError(path, "the file cannot be read; check its permissions");
  }
  auto content = parse_log(framing, bytes);
  if (!content) throw not_a_log(path);
  return std::move(content->records);
}

bool is_held(const std::filesystem::path& path) {
  const FileDescriptor file(path, O_RDONLY);
  return file.ok() && ::flock(file.id(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

}  // namespace episcope::io
