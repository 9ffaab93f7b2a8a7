// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/durable/record_log.h"

#include "engine/core/error.h"
#include "engine/io/durable/atomic_file.h"
#include "engine/io/durable/checksum.h"
#include "engine/io/durable/system_error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <utility>

namespace episcope::io {
namespace {

constexpr std::array<std::uint8_t, 8> kSignature{'E', 'P', 'I', 'L', 'O', 'G', '1', '\n'};
constexpr std::size_t kFrame = 8;  ///< Length and checksum, 32 bits each, lowest byte first.
constexpr std::size_t kMaxRecord = std::size_t{1} << 31;

void put_number(std::size_t number, RecordLog::Record& out) {
  for (int shift = 0; shift < 32; shift += 8) {
    out.push_back(static_cast<std::uint8_t>(number >> shift));
  }
}

std::uint32_t number_at(std::span<const std::uint8_t> bytes) {
  return std::uint32_t{bytes[0]} | std::uint32_t{bytes[1]} << 8 | std::uint32_t{bytes[2]} << 16 |
         std::uint32_t{bytes[3]} << 24;
}

/// The checksum also covers the length: zeros are no record.
std::uint32_t checksum_of(std::span<const std::uint8_t> record) {
  return checksum(record) ^ static_cast<std::uint32_t>(record.size()) ^ 0xA5A5A5A5U;
}

void put_record(std::span<const std::uint8_t> record, RecordLog::Record& out) {
  if (record.size() > kMaxRecord) throw InvalidInput("a record of more than 2 GiB cannot be kept");
  put_number(record.size(), out);
  put_number(checksum_of(record), out);
  out.insert(out.end(), record.begin(), record.end());
}

}  // namespace

RecordLog::RecordLog(const std::filesystem::path& path, std::span<const Record> records)
    : path_(path) {
  Record bytes(kSignature.begin(), kSignature.end());
  for (const Record& record : records) put_record(record, bytes);
  AtomicFile target(path, bytes.size());
  errno = 0;
  file_ = FileDescriptor(target.temporary(), O_WRONLY | O_APPEND);
  // Held before it has its name: nobody can take it for one that was left.
  if (!file_.ok() || ::flock(file_.id(), LOCK_EX | LOCK_NB) != 0 || !write_all(file_.id(), bytes)) {
    throw write_error(path);
  }
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored)) {
    target.commit();  // a loss of power must not cost the records that are there
  } else {
    target.commit_unflushed();
    written_ = 1;
  }
  bytes_ = bytes.size();
  flusher_ = std::jthread([this](const std::stop_token& stop) { flush_in_background(stop); });
}

RecordLog::~RecordLog() {
  flusher_.request_stop();
  flusher_.join();
}

void RecordLog::append(std::span<const std::uint8_t> record) {
  require_flushed();
  Record bytes;
  put_record(record, bytes);
  errno = 0;
  if (!write_all(file_.id(), bytes)) {
    const IoError error = write_error(path_);
    is_broken_ = ::ftruncate(file_.id(), static_cast<off_t>(bytes_)) != 0;
    throw error;
  }
  bytes_ += bytes.size();
  const std::scoped_lock lock(mutex_);
  ++written_;
  changed_.notify_all();
}

void RecordLog::flush() {
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return flushed_ == written_ || flush_error_ != 0; });
  }
  require_flushed();
}

void RecordLog::require_flushed() {
  const std::scoped_lock lock(mutex_);
  if (flush_error_ == 0 && !is_broken_) return;
  errno = flush_error_;
  throw write_error(path_);
}

void RecordLog::flush_in_background(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  for (bool is_named = written_ == 0;;) {
    changed_.wait(lock, stop, [this] { return flushed_ != written_; });
    if (flushed_ == written_) return;
    const std::uint64_t reached = written_;
    lock.unlock();
    const int error = ::fdatasync(file_.id()) == 0 ? 0 : errno;
    if (!std::exchange(is_named, true)) flush_folder(path_);
    lock.lock();
    flushed_ = reached;
    if (error != 0) flush_error_ = error;
    changed_.notify_all();
  }
}

std::vector<RecordLog::Record> read_records(const std::filesystem::path& path) {
  require_readable_file(path);
  const FileDescriptor file(path, O_RDONLY);
  RecordLog::Record bytes;
  if (!file.ok() || !read_all(file.id(), bytes)) {
    throw IoError(path, "the file cannot be read; check its permissions");
  }
  if (bytes.size() < kSignature.size() ||
      !std::equal(kSignature.begin(), kSignature.end(), bytes.begin())) {
    throw IoError(path, "this is no log of this program; choose another file");
  }
  std::vector<RecordLog::Record> records;
  std::span<const std::uint8_t> rest(bytes);
  rest = rest.subspan(kSignature.size());
  while (rest.size() >= kFrame) {
    const std::size_t length = number_at(rest);
    if (rest.size() - kFrame < length) break;
    const auto record = rest.subspan(kFrame, length);
    if (checksum_of(record) != number_at(rest.subspan(4))) break;
    records.emplace_back(record.begin(), record.end());
    rest = rest.subspan(kFrame + length);
  }
  return records;
}

bool is_held(const std::filesystem::path& path) {
  const FileDescriptor file(path, O_RDONLY);
  return file.ok() && ::flock(file.id(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

}  // namespace episcope::io
