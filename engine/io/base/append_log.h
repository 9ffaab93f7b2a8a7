// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/base/files.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace episcope::io {

using LogRecord = std::vector<std::uint8_t>;

/// How the records of a log are stored in its file.
enum class LogFraming {
  Lines,    ///< Text: a record is a line, and holds no line break.
  Checked,  ///< Binary: a signature, then every record after its length and a checksum.
};

/// When a log flushes what was appended to the disk.
enum class LogFlush {
  AtOnce,        ///< Before `append` returns.
  InBackground,  ///< Soon after, so that the caller never waits for a disk.
};

class BackgroundFlush;

/// A file that grows by whole records. A record is in the file when `append` returns; it survives
/// any end of the program. No other process can hold the log while it is open. The system releases
/// it when the program ends.
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
  ~AppendLog();

  /// Records found when the log was opened.
  [[nodiscard]] const std::vector<LogRecord>& records() const { return records_; }
  /// Throws IoError, also if a flush in the background failed before. The log is then as it was
  /// before the call; if even that failed, it accepts no more records.
  void append(std::span<const std::uint8_t> record);
  void append(std::string_view record);
  /// Appends several records in one write, as `append` does.
  void append_all(std::span<const LogRecord> records);
  /// Waits until all records are on the disk. Throws IoError.
  void flush();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::uintmax_t byte_size() const { return bytes_; }

 private:
  void read_records();
  void start_flush(LogFlush flush, bool is_flushed);
  void require_sound();
  void write(std::span<const std::uint8_t> bytes);

  std::filesystem::path path_;
  LogFraming framing_;
  FileDescriptor file_;
  std::vector<LogRecord> records_;
  std::uintmax_t bytes_ = 0;
  bool is_broken_ = false;
  std::unique_ptr<BackgroundFlush> flush_;  ///< Null: at once.
};

/// Reads a log that another process may hold, without changing the file. Throws IoError if it
/// cannot be read or is no such log.
[[nodiscard]] std::vector<LogRecord> read_log(const std::filesystem::path& path,
                                              LogFraming framing);

/// Whether a living process has the log open. False if there is no such file.
[[nodiscard]] bool is_held(const std::filesystem::path& path);

/// CRC-32 as in PNG (ISO 3309).
[[nodiscard]] std::uint32_t checksum(std::span<const std::uint8_t> bytes);

}  // namespace episcope::io
