// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Directories and tags of a TIFF or BigTIFF file; reads them from the file at each call.
class TiffFile {
 public:
  /// Value of a tag.
  struct Value {
    std::uint64_t type = 0;    ///< As the file numbers types: 3 = 16 bit, 4 = 32 bit, 5 = ratio.
    std::uint64_t place = 0;   ///< Where the first value lies,
    std::uint64_t bytes = 0;   ///< and how many bytes all have.
    std::uint64_t number = 0;  ///< The first, if it is a whole number.
  };

  explicit TiffFile(const std::filesystem::path& path);

  /// Whether the file begins as a TIFF or BigTIFF file.
  [[nodiscard]] bool is_tiff() const { return is_tiff_; }
  [[nodiscard]] bool is_little_endian() const { return is_little_endian_; }

  /// Lengths of a place and of an entry in this file, and where the place of page 1 is stored.
  [[nodiscard]] std::uint64_t place_bytes() const { return is_big_ ? 8 : 4; }
  [[nodiscard]] std::uint64_t entry_bytes() const { return is_big_ ? 20 : 12; }
  [[nodiscard]] std::uint64_t place_of_start() const { return is_big_ ? 8 : 4; }

  /// Places of the directories of pages, up to `most` + 1; fewer if one is damaged. Empty for other
  /// files.
  [[nodiscard]] std::vector<std::uint64_t> directories(int most);
  /// A tag in the directory at `directory`; nothing if it is not there.
  [[nodiscard]] std::optional<Value> tag(std::uint64_t directory, std::uint64_t tag);
  /// A tag of the first page.
  [[nodiscard]] std::optional<Value> tag(std::uint64_t tag) { return this->tag(first_page(), tag); }

  /// Up to `bytes` bytes from `place` on.
  [[nodiscard]] std::string text(std::uint64_t place, std::uint64_t bytes);
  /// An unsigned number of 1 to 8 bytes in the order of the file; 0 behind its end.
  [[nodiscard]] std::uint64_t at(std::uint64_t place, std::uint64_t bytes);

 private:
  [[nodiscard]] std::uint64_t count_bytes() const { return is_big_ ? 8 : 2; }
  [[nodiscard]] std::uint64_t first_page() { return at(place_of_start(), place_bytes()); }

  std::ifstream in_;
  bool is_little_endian_ = false;
  bool is_big_ = false;
  bool is_tiff_ = false;
};

}  // namespace episcope::io
