// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/frames/tiff_pages.h"

#include <algorithm>
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

  /// How long places, numbers of entries, and entries are.
  [[nodiscard]] std::uint64_t place_bytes() const { return is_big_ ? 8 : 4; }
  [[nodiscard]] std::uint64_t count_bytes() const { return is_big_ ? 8 : 2; }
  [[nodiscard]] std::uint64_t entry_bytes() const { return is_big_ ? 20 : 12; }

  [[nodiscard]] std::uint64_t place_of_first_page() { return at(is_big_ ? 8 : 4, place_bytes()); }

  [[nodiscard]] std::string text(std::uint64_t place, std::uint64_t bytes) {
    std::string read(static_cast<std::size_t>(bytes), '\0');
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(place));
    in_.read(read.data(), static_cast<std::streamsize>(bytes));
    read.resize(static_cast<std::size_t>(in_.gcount()));
    return read;
  }

  /// 0 behind the end.
  [[nodiscard]] std::uint64_t at(std::uint64_t place, std::uint64_t bytes) {
    std::array<unsigned char, 8> read{};
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(place));
    if (!in_.read(reinterpret_cast<char*>(read.data()), static_cast<std::streamsize>(bytes))) {
      return 0;
    }
    std::uint64_t number = 0;
    for (std::uint64_t i = 0; i < bytes; ++i) {
      number = number << 8 | read[is_little_endian_ ? bytes - 1 - i : i];
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
  int pages = 0;
  // Directories that lead back to themselves end at `most`.
  std::uint64_t place = file.place_of_first_page();
  for (; place != 0 && pages <= most; ++pages) {
    const std::uint64_t entries = file.at(place, file.count_bytes());
    if (entries == 0) return 0;
    place = file.at(place + file.count_bytes() + file.entry_bytes() * entries, file.place_bytes());
  }
  return pages;
}

std::string tiff_description(const std::filesystem::path& path) {
  constexpr std::uint64_t kDescription = 270;
  constexpr std::uint64_t kMostEntries = 1000;
  constexpr std::uint64_t kMostBytes = 64 << 10;
  Numbers file(path);
  if (!file.is_tiff()) return {};
  std::uint64_t entry = file.place_of_first_page();
  const std::uint64_t entries = std::min(kMostEntries, file.at(entry, file.count_bytes()));
  entry += file.count_bytes();
  for (std::uint64_t i = 0; i < entries; ++i, entry += file.entry_bytes()) {
    if (file.at(entry, 2) != kDescription) continue;
    const std::uint64_t bytes = file.at(entry + 4, file.place_bytes());
    const std::uint64_t value = entry + 4 + file.place_bytes();
    const bool is_inside = bytes <= file.place_bytes();
    const std::uint64_t place = is_inside ? value : file.at(value, file.place_bytes());
    std::string text = file.text(place, std::min(bytes, kMostBytes));
    return text.substr(0, text.find('\0'));
  }
  return {};
}

}  // namespace episcope::io
