// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/durable/checksum.h"

#include <array>

namespace episcope::io {
namespace {

constexpr std::array<std::uint32_t, 256> checksum_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t value = byte;
    for (int bit = 0; bit < 8; ++bit)
      value = (value & 1U) != 0 ? 0xEDB88320U ^ (value >> 1) : value >> 1;
    table[byte] = value;
  }
  return table;
}

}  // namespace

std::uint32_t checksum(std::span<const std::uint8_t> bytes) {
  static constexpr std::array<std::uint32_t, 256> table = checksum_table();
  std::uint32_t value = 0xFFFFFFFFU;
  for (const std::uint8_t byte : bytes) value = table[(value ^ byte) & 0xFFU] ^ (value >> 8);
  return ~value;
}

}  // namespace episcope::io
