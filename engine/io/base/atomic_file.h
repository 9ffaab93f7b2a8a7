// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

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

}  // namespace episcope::io
