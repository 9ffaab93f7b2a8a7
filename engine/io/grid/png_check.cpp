// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/png_check.h"

#include "engine/io/durable/checksum.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <span>
#include <string_view>
#include <vector>

namespace episcope::io {
namespace {

constexpr std::array<std::uint8_t, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
constexpr std::size_t kFrame = 12;  ///< Length, type and checksum of a chunk.

std::uint32_t big_endian(const std::uint8_t* bytes) {
  return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 |
         std::uint32_t{bytes[2]} << 8 | bytes[3];
}

bool has_whole_chunks(std::span<const std::uint8_t> bytes) {
  while (bytes.size() >= kFrame) {
    const std::size_t length = big_endian(bytes.data());
    if (bytes.size() - kFrame < length) return false;
    const auto typed = bytes.subspan(4, 4 + length);
    if (checksum(typed) != big_endian(bytes.data() + 8 + length)) return false;
    constexpr std::string_view end = "IEND";
    if (std::equal(end.begin(), end.end(), typed.begin())) return true;
    bytes = bytes.subspan(kFrame + length);
  }
  return false;
}

}  // namespace

bool is_damaged_png(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 8> begin{};
  file.read(begin.data(), begin.size());
  const bool is_png = std::equal(kSignature.begin(), kSignature.end(), begin.begin(),
                                 [](std::uint8_t expected, char found) {
                                   return expected == static_cast<std::uint8_t>(found);
                                 });
  if (!file || !is_png) return false;
  file.seekg(0, std::ios::end);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(file.tellg()) - begin.size());
  file.seekg(begin.size());
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return !file || !has_whole_chunks(bytes);
}

}  // namespace episcope::io
