// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/frames/tiff_pages.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <string>

namespace episcope::io {
namespace {

/// Unsigned numbers of a file, in its byte order.
class Numbers {
 public:
  explicit Numbers(const std::filesystem::path& path) : in_(path, std::ios::binary) {
    std::string begin(4, '\0');
    in_.read(begin.data(), 4);
    is_little_endian_ = begin.starts_with("II");
    is_big_ = begin == std::string("II+\0", 4) || begin == std::string("MM\0+", 4);
    const bool is_plain = begin == std::string("II*\0", 4) || begin == std::string("MM\0*", 4);
    is_tiff_ = in_ && (is_plain || is_big_);
  }

  [[nodiscard]] bool is_tiff() const { return is_tiff_; }
  /// Whether places take 8 bytes: BigTIFF.
  [[nodiscard]] bool is_big() const { return is_big_; }

  /// 0 behind the end.
  [[nodiscard]] std::uint64_t at(std::uint64_t place, int bytes) {
    std::array<unsigned char, 8> read{};
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(place));
    if (!in_.read(reinterpret_cast<char*>(read.data()), bytes)) return 0;
    std::uint64_t number = 0;
    for (int i = 0; i < bytes; ++i) {
      const int next = is_little_endian_ ? bytes - 1 - i : i;
      number = number << 8 | read[static_cast<std::size_t>(next)];
    }
    return number;
  }

 private:
  std::ifstream in_;
  bool is_little_endian_ = false;
  bool is_big_ = false;
  bool is_tiff_ = false;
};

}  // namespace

int count_tiff_pages(const std::filesystem::path& path, int most) {
  Numbers file(path);
  if (!file.is_tiff()) return 0;
  const int place_bytes = file.is_big() ? 8 : 4;
  const int count_bytes = file.is_big() ? 8 : 2;
  const std::uint64_t entry_bytes = file.is_big() ? 20 : 12;
  int pages = 0;
  // Directories that lead back to themselves end at `most`.
  std::uint64_t place = file.at(file.is_big() ? 8 : 4, place_bytes);
  for (; place != 0 && pages <= most; ++pages) {
    const std::uint64_t entries = file.at(place, count_bytes);
    if (entries == 0) return 0;
    place = file.at(place + count_bytes + entry_bytes * entries, place_bytes);
  }
  return pages;
}

}  // namespace episcope::io
