// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/durable/atomic_file.h"
#include "engine/io/durable/file_descriptor.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace episcope::io {

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

}  // namespace episcope::io
