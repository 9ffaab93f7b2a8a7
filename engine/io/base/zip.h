// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"

#include <zlib.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace episcope::io {

/// A file inside a zip archive.
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

/// Writes a zip archive of files that are not compressed (zip64 where sizes need it) to the
/// temporary place of an atomic file. Source: PKWARE APPNOTE 6.3.10.
class ZipWriter {
 public:
  explicit ZipWriter(const AtomicFile& file);

  /// Adds a file that consists of these parts. Throws IoError.
  void add(const std::string& name, const std::vector<std::span<const std::uint8_t>>& parts);
  /// Writes the directory and closes. Throws IoError.
  void close();

 private:
  struct Entry {
    std::string name;
    std::uint32_t checksum = 0;
    std::uint64_t size = 0;
    std::uint64_t begin = 0;
  };
  void write(std::span<const std::uint8_t> bytes);

  std::filesystem::path path_;
  FileDescriptor file_;
  std::vector<Entry> entries_;
  std::uint64_t position_ = 0;
};

/// Inflates a deflated part of a file from its front to its end.
class InflateStream {
 public:
  /// A file inside a zip archive.
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
  /// Skips to `position`, which must not lie behind; false if the stream ends before.
  [[nodiscard]] bool skip_to(std::uint64_t position);
  /// Reads on to the checksum if all data was read; whether no damage was found so far.
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
