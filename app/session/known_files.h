// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace episcope {

/// Size and time of a file, which tell whether it is as it was last read or written.
struct FileStamp {
  std::uintmax_t bytes = 0;
  std::filesystem::file_time_type changed{};
  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

/// The stamp of a file as it is now; the default one if there is none.
[[nodiscard]] FileStamp stamp_of(const std::filesystem::path& path);

/// Stamps of files that were read or written here, so that changes by other programs are not
/// overwritten unnoticed.
class KnownFiles {
 public:
  void note(const std::filesystem::path& file, const FileStamp& stamp);
  /// As it is now; that there is none is noted as well.
  void note(const std::filesystem::path& file) { note(file, stamp_of(file)); }
  /// Whether a file that was noted is there and another one now. False for other files.
  [[nodiscard]] bool has_changed(const std::filesystem::path& file) const;

 private:
  std::map<std::filesystem::path, FileStamp> stamps_;
};

/// A name as any file system takes it: without separators and the like, in UTF-8, and not too long.
[[nodiscard]] std::string file_name_of(std::string name);

}  // namespace episcope
