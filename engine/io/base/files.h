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
#include <vector>

namespace episcope::io {

/// A file of the system, closed at the end of its scope and not handed to child processes.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  /// As open(2), with permissions 0666; see `ok`.
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

/// The same at `offset` of the file.
[[nodiscard]] bool write_all_at(int descriptor, std::span<const std::uint8_t> bytes,
                                std::uintmax_t offset);
/// Fills `bytes` from there; false also if the file ends before.
[[nodiscard]] bool read_all_at(int descriptor, std::span<std::uint8_t> bytes,
                               std::uintmax_t offset);

/// Reads from here to the end; false leaves the reason in `errno`.
[[nodiscard]] bool read_all(int descriptor, std::vector<std::uint8_t>& bytes);

/// Throws IoError with one sentence unless `path` is a file that can be opened for reading.
void require_readable_file(const std::filesystem::path& path);

/// Why writing to `path` failed and what to do about it, from `errno` and the free space.
[[nodiscard]] IoError write_error(const std::filesystem::path& path);

/// Makes a folder and those above it, unless it is there. Throws IoError: "the folder cannot be
/// created (why)" followed by `advice`, which begins with its own punctuation.
void make_folder(const std::filesystem::path& folder,
                 std::string_view advice = "; choose another one");

/// Whether a path is a folder, or something in it or below, when all links are followed. What does
/// not exist yet counts by the folders that do. No if that cannot be found out.
[[nodiscard]] bool is_inside_folder(const std::filesystem::path& path,
                                    const std::filesystem::path& folder);

/// From now on a file that grows beyond what the process may write (`ulimit -f`, limits of a batch
/// system) is an error of the write (EFBIG, which `write_error` puts in words). By default the
/// signal SIGXFSZ ends the program and leaves what is unfinished behind. For `main`.
void report_file_size_limit();

/// The finite number that the whole of `text` spells, with a dot whatever the locale.
[[nodiscard]] inline std::optional<double> parse_number(const std::string& text) {
  double value = 0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || begin == end || !std::isfinite(value)) return {};
  return value;
}

}  // namespace episcope::io
