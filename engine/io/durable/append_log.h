// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/durable/file_descriptor.h"

#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// A text file that only grows, by whole lines: what was added stays, whenever the program ends. A
/// last line without its end, which a crash in the middle of writing leaves, is dropped. One
/// program at a time may hold a log.
class AppendLog {
 public:
  /// Opens or creates the log and reads its lines. Throws IoError, also if another program
  /// holds it.
  explicit AppendLog(const std::filesystem::path& path);

  /// The lines that were there when it was opened, without their ends.
  [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }
  /// Adds a line, which must not hold a line break, and flushes it to the disk. Throws IoError; the
  /// log then is as it was.
  void append(const std::string& line);

 private:
  void read_lines();

  std::filesystem::path path_;
  FileDescriptor file_;
  std::vector<std::string> lines_;
};

}  // namespace episcope::io
