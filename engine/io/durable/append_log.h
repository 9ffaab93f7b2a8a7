// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/durable/background_flush.h"
#include "engine/io/durable/file_descriptor.h"
#include "engine/io/durable/log_framing.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace episcope::io {

/// When a log flushes what was appended to the disk.
enum class LogFlush {
  AtOnce,        ///< Before `append` returns.
  InBackground,  ///< Soon after, so that the caller never waits for a disk.
};

/// A file that only grows, by whole records. A record is in the file when `append` returns, and
/// survives the end of the program, whatever its cause. While the log is open no other process can
/// hold it; the system releases it when the program ends.
class AppendLog {
 public:
  /// Opens the log, or creates an empty one. Anything after the last whole record (parse_log) is
  /// discarded. Throws IoError, also if another process holds the log or the file is not such a
  /// log.
  AppendLog(const std::filesystem::path& path, LogFraming framing, LogFlush flush);
  /// Creates a log of these records, which appears under its name once it is complete; it replaces
  /// an existing one only when it is on the disk as well. Throws IoError.
  AppendLog(const std::filesystem::path& path, LogFraming framing, LogFlush flush,
            std::span<const LogRecord> records);

  /// The records that were there when it was opened.
  [[nodiscard]] const std::vector<LogRecord>& records() const { return records_; }
  /// Throws IoError, also if a flush in the background failed before. The log is then as it was
  /// before the call; if even that failed, it accepts no more records.
  void append(std::span<const std::uint8_t> record);
  void append(std::string_view record);
  /// Several records in one write; as `append`.
  void append_all(std::span<const LogRecord> records);
  /// Waits until all records are on the disk. Throws IoError.
  void flush();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::uintmax_t byte_size() const { return bytes_; }

 private:
  void read_records();
  void start_flush(LogFlush flush, BackgroundFlush::Start start);
  void require_sound();
  void write(std::span<const std::uint8_t> bytes);

  std::filesystem::path path_;
  LogFraming framing_;
  FileDescriptor file_;
  std::vector<LogRecord> records_;
  std::uintmax_t bytes_ = 0;
  bool is_broken_ = false;
  std::optional<BackgroundFlush> flush_;  ///< None: at once.
};

/// The records of a log that another process may hold; the file stays as it is. Throws IoError if
/// it cannot be read or is no such log.
[[nodiscard]] std::vector<LogRecord> read_log(const std::filesystem::path& path,
                                              LogFraming framing);

/// Whether a living process has the log open. False if there is no such file.
[[nodiscard]] bool is_held(const std::filesystem::path& path);

}  // namespace episcope::io
