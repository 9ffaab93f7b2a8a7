// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/arrays/zip_file.h"

#include <zlib.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

namespace episcope::io {

/// Inflates a deflated part of a file from its front to its end.
class InflateStream {
 public:
  /// A file inside of a zip archive.
  InflateStream(const std::filesystem::path& path, const ZipEntry& entry);
  /// `bytes` bytes from `begin` on, in the form of zlib.
  InflateStream(const std::filesystem::path& path, std::uint64_t begin, std::uint64_t bytes);
  ~InflateStream();
  InflateStream(const InflateStream&) = delete;
  InflateStream& operator=(const InflateStream&) = delete;

  /// Inflated bytes that have been read or skipped.
  [[nodiscard]] std::uint64_t position() const { return position_; }
  /// Reads up to `bytes`; fewer at the end, or where the data are damaged.
  std::size_t read(std::size_t bytes, std::uint8_t* out);
  /// Whether `position` was reached, which must not be behind.
  [[nodiscard]] bool skip_to(std::uint64_t position);
  /// Reads a little more, with the checksum if that is all; whether nothing was damaged so far.
  [[nodiscard]] bool ends_well();

 private:
  InflateStream(const std::filesystem::path& path, std::uint64_t begin, std::uint64_t bytes,
                int window);
  [[nodiscard]] bool refill();

  std::ifstream in_;
  std::uint64_t left_ = 0;
  std::uint64_t position_ = 0;
  bool is_damaged_ = false;
  std::vector<std::uint8_t> piece_;
  z_stream state_{};
};

}  // namespace episcope::io
