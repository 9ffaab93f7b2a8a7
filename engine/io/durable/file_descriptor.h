// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
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

}  // namespace episcope::io
