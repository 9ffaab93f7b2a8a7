// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/base/files.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace episcope::io {

/// A file that appears under its name only when it is complete. It is written as a hidden temporary
/// file in the same folder, flushed, then renamed over the old one. Before `commit`, the old file
/// stays and the destructor removes the temporary one. After a kill, the next writer of the same
/// file on this machine removes it.
class AtomicFile {
 public:
  /// Creates the temporary file. `bytes`: the expected size, to refuse at once what cannot fit.
  /// Throws IoError if the folder is not writable or lacks the space, or if `target` exists and is
  /// not a regular file.
  explicit AtomicFile(const std::filesystem::path& target, std::uintmax_t bytes = 0);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// The path that the caller gave.
  [[nodiscard]] const std::filesystem::path& target() const { return named_; }
  /// Where to write until `commit`.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  /// The temporary file must be closed. Throws IoError that names the target.
  void commit();
  /// Commits without waiting for the disk; for files that do not exist yet. Until it is flushed, a
  /// power failure may leave the file truncated. The end of the program cannot.
  void commit_unflushed();

 private:
  std::filesystem::path named_;
  std::filesystem::path target_;     ///< The file itself, where the name is a symbolic link.
  std::filesystem::path temporary_;  ///< Empty once renamed.
};

/// Flushes the names in the folder of `target` to the disk; failures are ignored.
void flush_folder(const std::filesystem::path& target);

/// Writes a whole file through AtomicFile. Throws IoError.
void write_atomically(const std::filesystem::path& target, std::span<const std::uint8_t> bytes);
void write_atomically(const std::filesystem::path& target, std::string_view text);

/// A folder that appears under its name only when it is complete. It is filled as a hidden folder
/// beside `target`, then renamed. Before `commit`, nothing exists under the name, and the
/// destructor removes what was written.
class AtomicFolder {
 public:
  /// `bytes`: the expected size, to refuse at once what cannot fit. Throws IoError if `target` is a
  /// file or holds files, or if nothing can be written beside it.
  explicit AtomicFolder(const std::filesystem::path& target, std::uintmax_t bytes = 0);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// Where to write until `commit`.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  /// Throws IoError that names the target.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;  ///< Empty once renamed.
};

/// A hidden name beside `target` that no other program on any machine uses:
/// `.NAME.<machine>-<process>-<random>-<count>.part`.
[[nodiscard]] std::string temporary_name(const std::filesystem::path& target);

/// The folder that holds `target`.
[[nodiscard]] std::filesystem::path folder_of(const std::filesystem::path& target);

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
