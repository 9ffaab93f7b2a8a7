// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace episcope::io {

/// A file of the system, closed at the end of its scope and not handed to child processes.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  /// Opens as open(2) does, with permissions 0666; see `ok`.
  FileDescriptor(const std::filesystem::path& path, int flags);
  ~FileDescriptor();
  FileDescriptor(FileDescriptor&& other) noexcept;
  FileDescriptor& operator=(FileDescriptor&& other) noexcept;

  [[nodiscard]] bool ok() const { return id_ >= 0; }
  [[nodiscard]] int id() const { return id_; }

 private:
  int id_ = -1;
};

/// Writes all bytes; false leaves the reason in `errno`.
[[nodiscard]] bool write_all(int descriptor, std::span<const std::uint8_t> bytes);

/// Writes all bytes at `offset` of the file.
[[nodiscard]] bool write_all_at(int descriptor, std::span<const std::uint8_t> bytes,
                                std::uintmax_t offset);
/// Fills `bytes` from `offset` on; false also if the file ends before.
[[nodiscard]] bool read_all_at(int descriptor, std::span<std::uint8_t> bytes,
                               std::uintmax_t offset);

/// Reads from the current position to the end; false leaves the reason in `errno`.
[[nodiscard]] bool read_all(int descriptor, std::vector<std::uint8_t>& bytes);

/// The end of a sentence on a file without content.
inline constexpr const char* kEmptyFile = "the file is empty; copy or download it again";

/// Throws IoError with one sentence unless `path` is a file that can be opened for reading.
void require_openable_file(const std::filesystem::path& path);

/// The same, also for content that no reader reads (foreign_content.h).
void require_readable_file(const std::filesystem::path& path);

/// Why writing to `path` failed and what to do about it, from `errno` and the free space.
[[nodiscard]] IoError write_error(const std::filesystem::path& path);

/// Whether a file or folder exists; false for a link that leads to itself. Likewise a file, or a
/// folder.
[[nodiscard]] inline bool is_there(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}
[[nodiscard]] inline bool is_file(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}
[[nodiscard]] inline bool is_folder(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored);
}

/// Creates a folder and its parents where they are missing. Throws IoError: "the folder cannot be
/// created (why)" followed by `advice`, which begins with its own punctuation.
void make_folder(const std::filesystem::path& folder,
                 std::string_view advice = "; choose another one");

/// Whether `path`, with all links followed, is `folder` or lies in it. A path that does not exist
/// yet counts by its existing parents. False if this cannot be determined.
[[nodiscard]] bool is_inside_folder(const std::filesystem::path& path,
                                    const std::filesystem::path& folder);

/// Whether the suffix is one that `decode_image` (image_file.h) reads.
[[nodiscard]] bool is_image_name(const std::filesystem::path& path);

/// Lists the images directly in a folder, by name. Omits hidden files and links that lead nowhere
/// or to themselves. Throws filesystem_error if the folder cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> list_images(const std::filesystem::path& folder);

/// Lists the visible folders directly in a folder, in any order; none if it cannot be opened.
[[nodiscard]] std::vector<std::filesystem::path> list_folders(const std::filesystem::path& folder);

/// Number of images directly in a folder; 0 if there is no such folder.
[[nodiscard]] int count_images(const std::filesystem::path& folder);

/// Turns the signal of a file beyond the size limit of the process (`ulimit -f`, batch systems)
/// into a failed write: EFBIG, which `write_error` explains. By default SIGXFSZ ends the program
/// and leaves temporary files. To be called by `main`.
void report_file_size_limit();

/// Parses all of `text` as a finite number with a decimal point, regardless of the locale.
[[nodiscard]] inline std::optional<double> parse_number(const std::string& text) {
  double value = 0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || begin == end || !std::isfinite(value)) return {};
  return value;
}

}  // namespace episcope::io
