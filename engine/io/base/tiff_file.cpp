// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/tiff_file.h"

#include <algorithm>
#include <array>

namespace episcope::io {

TiffFile::TiffFile(const std::filesystem::path& path) : in_(path, std::ios::binary) {
  std::string begin(4, '\0');
  in_.read(begin.data(), 4);
  is_little_endian_ = begin.starts_with("II");
  is_big_ = begin == std::string("II+\0", 4) || begin == std::string("MM\0+", 4);
  const bool is_plain = begin == std::string("II*\0", 4) || begin == std::string("MM\0*", 4);
  is_tiff_ = in_ && (is_plain || is_big_);
}

std::string TiffFile::text(std::uint64_t place, std::uint64_t bytes) {
  std::string read(static_cast<std::size_t>(bytes), '\0');
  in_.clear();
  in_.seekg(static_cast<std::streamoff>(place));
  in_.read(read.data(), static_cast<std::streamsize>(bytes));
  read.resize(static_cast<std::size_t>(in_.gcount()));
  return read;
}

std::uint64_t TiffFile::at(std::uint64_t place, std::uint64_t bytes) {
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

std::vector<std::uint64_t> TiffFile::directories(int most) {
  std::vector<std::uint64_t> places;
  if (!is_tiff()) return places;
  // Directories that lead back to themselves end at `most`.
  std::uint64_t place = first_page();
  while (place != 0 && static_cast<int>(places.size()) <= most) {
    const std::uint64_t entries = at(place, count_bytes());
    if (entries == 0) return {};
    places.push_back(place);
    place = at(place + count_bytes() + entry_bytes() * entries, place_bytes());
  }
  return places;
}

std::optional<TiffFile::Value> TiffFile::tag(std::uint64_t directory, std::uint64_t tag) {
  constexpr std::uint64_t kMostEntries = 1000;
  constexpr std::array<std::uint64_t, 6> kSizes{0, 1, 1, 2, 4, 8};  // of types
  if (!is_tiff()) return std::nullopt;
  const std::uint64_t entries = std::min(kMostEntries, at(directory, count_bytes()));
  std::uint64_t entry = directory + count_bytes();
  for (std::uint64_t i = 0; i < entries; ++i, entry += entry_bytes()) {
    if (at(entry, 2) != tag) continue;
    const std::uint64_t type = at(entry + 2, 2);
    const std::uint64_t size = type < kSizes.size() ? kSizes[type] : 8;
    Value value{type, entry + 4 + place_bytes(), size * at(entry + 4, place_bytes())};
    if (value.bytes > place_bytes()) value.place = at(value.place, place_bytes());
    value.number = at(value.place, size);
    return value;
  }
  return std::nullopt;
}

}  // namespace episcope::io
