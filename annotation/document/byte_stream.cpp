// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/document/byte_stream.h"

#include "engine/core/error.h"

namespace episcope {
namespace {

constexpr std::uint8_t kMore = 0x80;
constexpr int kGroup = 7;

[[noreturn]] void refuse() {
  throw InvalidInput("the recorded edits are truncated or damaged");
}

}  // namespace

void ByteWriter::number(std::uint64_t value) {
  for (; value >= kMore; value >>= kGroup) byte(static_cast<std::uint8_t>(value | kMore));
  byte(static_cast<std::uint8_t>(value));
}

void ByteWriter::text(const std::string& value) {
  number(value.size());
  bytes_.insert(bytes_.end(), value.begin(), value.end());
}

std::uint8_t ByteReader::byte() {
  if (rest_.empty()) refuse();
  const std::uint8_t value = rest_.front();
  rest_ = rest_.subspan(1);
  return value;
}

std::uint64_t ByteReader::number(std::uint64_t max) {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 64; shift += kGroup) {
    const std::uint8_t part = byte();
    value |= static_cast<std::uint64_t>(part & (kMore - 1)) << shift;
    if (part >= kMore) continue;
    if (value > max) refuse();
    return value;
  }
  refuse();
}

std::string ByteReader::text() {
  const auto size = static_cast<std::size_t>(number(rest_.size()));
  if (size > rest_.size()) refuse();
  std::string value(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(size));
  rest_ = rest_.subspan(size);
  return value;
}

}  // namespace episcope
