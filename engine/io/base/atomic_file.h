// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace episcope::io {

/// A file that appears under its name only when it is whole: written as a hidden temporary file in
/// the same folder, flushed to the disk, then renamed over the old one. Whatever happens before
/// `commit`, the old file stays and the destructor removes the temporary one; if the program is
/// killed, the next that writes the same file on this machine does.
class AtomicFile {
 public:
  /// Creates the temporary file. `bytes`: the expected size, to refuse at once what cannot fit.
  /// Throws IoError if the folder is not writable or lacks the space, or if `target` exists and is
  /// not a regular file.
  explicit AtomicFile(const std::filesystem::path& target, std::uintmax_t bytes = 0);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// As the caller named it.
  [[nodiscard]] const std::filesystem::path& target() const { return named_; }
  /// Where to write until `commit`.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  /// The temporary file must be closed. Throws IoError that names the target.
  void commit();
  /// As `commit`, but without waiting for the disk, for a file that does not exist yet: a power
  /// failure may leave it truncated until it is flushed, the end of the program cannot.
  void commit_unflushed();

 private:
  std::filesystem::path named_;
  std::filesystem::path target_;     ///< The file itself, where the name is a symbolic link.
  std::filesystem::path temporary_;  ///< Empty once renamed.
};

/// Flushes the names in the folder of a file to the disk, as far as that can be done.
void flush_folder(const std::filesystem::path& target);

/// Checks that `bytes` more fit on the disk that holds `folder`. Throws IoError naming `target`.
void require_space(const std::filesystem::path& target, const std::filesystem::path& folder,
                   std::uintmax_t bytes);

/// Writes a whole file through AtomicFile. Throws IoError.
void write_atomically(const std::filesystem::path& target, std::span<const std::uint8_t> bytes);
void write_atomically(const std::filesystem::path& target, std::string_view text);

/// A folder that appears under its name only when it is whole: filled as a hidden folder beside it,
/// then renamed. Whatever happens before `commit`, nothing is there under the name, and the
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

/// A hidden name for what becomes `target` when it is whole, used by no other program on any
/// machine: `.NAME.<machine>-<process>-<random>-<count>.part`.
[[nodiscard]] std::string temporary_name(const std::filesystem::path& target);

/// Removes, as far as that can be done, what programs of this machine that were killed have left
/// under such names beside `target`. Linear in the number of files of its folder.
void remove_abandoned(const std::filesystem::path& target);

/// The folder that holds `target`.
[[nodiscard]] std::filesystem::path folder_of(const std::filesystem::path& target);

}  // namespace episcope::io
