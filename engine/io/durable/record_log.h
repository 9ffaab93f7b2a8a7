// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/durable/file_descriptor.h"

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

namespace episcope::io {

/// A binary file that only grows, by whole records with a checksum each. A record is in the file
/// when `append` returns, so that it outlives the program whatever ends that; a thread of its own
/// flushes the file to the disk soon after, so that the caller never waits for a disk. While the
/// log is open no other process can hold it, and the system lets go of it when the program dies.
class RecordLog {
 public:
  using Record = std::vector<std::uint8_t>;

  /// Makes a file with these records, which appears under its name when it is whole; in the place
  /// of one that may be there only when it is on the disk as well. Throws IoError.
  RecordLog(const std::filesystem::path& path, std::span<const Record> records);
  /// Flushes.
  ~RecordLog();
  RecordLog(const RecordLog&) = delete;
  RecordLog& operator=(const RecordLog&) = delete;

  /// Throws IoError, also if a flush failed before; the log then is as it was, and no record is
  /// taken any more if not even that could be had.
  void append(std::span<const std::uint8_t> record);
  /// Waits until all records are on the disk. Throws IoError.
  void flush();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::uintmax_t byte_size() const { return bytes_; }

 private:
  void flush_in_background(const std::stop_token& stop);
  void require_flushed();

  std::filesystem::path path_;
  FileDescriptor file_;
  std::uintmax_t bytes_ = 0;
  bool is_broken_ = false;

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::uint64_t written_ = 0;  ///< Counts appends,
  std::uint64_t flushed_ = 0;  ///< and those on the disk.
  int flush_error_ = 0;        ///< `errno`.
  std::jthread flusher_;
};

/// The records of a log up to the first that is cut short or damaged, as the end of the program in
/// the middle of writing leaves it. Throws IoError if the file cannot be read or is no such log.
[[nodiscard]] std::vector<RecordLog::Record> read_records(const std::filesystem::path& path);

/// Whether a living process has the log open. False if there is no such file.
[[nodiscard]] bool is_held(const std::filesystem::path& path);

}  // namespace episcope::io
