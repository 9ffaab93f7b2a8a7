// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/durable/log_framing.h"

#include "engine/core/error.h"
#include "engine/io/durable/checksum.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace episcope::io {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::array<std::uint8_t, 8> kSignature{'E', 'P', 'I', 'L', 'O', 'G', '1', '\n'};
constexpr std::size_t kFrame = 8;  // length and checksum, 32 bits each, lowest byte first
constexpr std::size_t kMaxRecord = std::size_t{1} << 31;

void put_number(std::size_t number, std::vector<std::uint8_t>& bytes) {
  for (int shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<std::uint8_t>(number >> shift));
  }
}

std::uint32_t number_at(Bytes bytes) {
  return std::uint32_t{bytes[0]} | std::uint32_t{bytes[1]} << 8 | std::uint32_t{bytes[2]} << 16 |
         std::uint32_t{bytes[3]} << 24;
}

// It also covers the length: zeros are no record.
std::uint32_t checksum_of(Bytes record) {
  return checksum(record) ^ static_cast<std::uint32_t>(record.size()) ^ 0xA5A5A5A5U;
}

// A record at the beginning of some bytes, and how many of them it takes with its frame.
struct Framed {
  Bytes record;
  std::size_t size = 0;
};

std::optional<Framed> first_line(Bytes bytes) {
  const auto end = std::ranges::find(bytes, '\n');
  if (end == bytes.end()) return std::nullopt;
  const auto length = static_cast<std::size_t>(end - bytes.begin());
  return Framed{bytes.first(length), length + 1};
}

std::optional<Framed> first_checked(Bytes bytes) {
  if (bytes.size() < kFrame) return std::nullopt;
  const std::size_t length = number_at(bytes);
  if (bytes.size() - kFrame < length) return std::nullopt;
  const Bytes record = bytes.subspan(kFrame, length);
  if (checksum_of(record) != number_at(bytes.subspan(4))) return std::nullopt;
  return Framed{record, kFrame + length};
}

}  // namespace

Bytes log_signature(LogFraming framing) {
  return framing == LogFraming::Lines ? Bytes{} : Bytes{kSignature};
}

void put_record(LogFraming framing, Bytes record, std::vector<std::uint8_t>& bytes) {
  if (record.size() > kMaxRecord) throw InvalidInput("a record of more than 2 GiB cannot be kept");
  if (framing == LogFraming::Checked) {
    put_number(record.size(), bytes);
    put_number(checksum_of(record), bytes);
  }
  bytes.insert(bytes.end(), record.begin(), record.end());
  if (framing == LogFraming::Lines) {
    assert(std::ranges::find(record, '\n') == record.end());
    bytes.push_back('\n');
  }
}

std::optional<LogContent> parse_log(LogFraming framing, Bytes bytes) {
  const Bytes signature = log_signature(framing);
  if (bytes.size() < signature.size() ||
      !std::ranges::equal(signature, bytes.first(signature.size()))) {
    return std::nullopt;
  }
  LogContent content{{}, signature.size()};
  const auto first = framing == LogFraming::Lines ? first_line : first_checked;
  while (const auto framed = first(bytes.subspan(content.whole_bytes))) {
    content.records.emplace_back(framed->record.begin(), framed->record.end());
    content.whole_bytes += framed->size;
  }
  return content;
}

}  // namespace episcope::io
