// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// A file inside of a zip archive.
struct ZipEntry {
  std::string name;
  std::uint64_t begin = 0;   ///< Where its bytes are in the archive,
  std::uint64_t stored = 0;  ///< and how many.
  std::uint64_t size = 0;    ///< As the archive claims, once inflated.
  bool is_deflated = false;
};

/// Whether a file begins as a zip archive.
[[nodiscard]] bool has_zip_signature(const std::filesystem::path& path);

/// The files in a zip archive (stored or deflated; zip64). Source: PKWARE APPNOTE 6.3.10. Throws
/// IoError for a truncated or damaged archive, an encrypted one, and other compression.
[[nodiscard]] std::vector<ZipEntry> list_zip(const std::filesystem::path& path);

}  // namespace episcope::io
