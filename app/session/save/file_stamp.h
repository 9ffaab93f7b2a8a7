// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

namespace episcope {

/// By which a file is known to be as it was read or written last.
struct FileStamp {
  std::uintmax_t bytes = 0;
  std::filesystem::file_time_type changed{};
  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

/// The stamp of a file as it is now; the default one if there is none.
[[nodiscard]] FileStamp stamp_of(const std::filesystem::path& path);

}  // namespace episcope
