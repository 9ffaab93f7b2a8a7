// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "annotation/edit.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace episcope {

/// Appends numbers and text to bytes, in a form that is the same on every machine: whole numbers in
/// groups of 7 bits, the lowest first, all but the last with the high bit set.
class ByteWriter {
 public:
  void byte(std::uint8_t value) { bytes_.push_back(value); }
  void number(std::uint64_t value);
  void text(const std::string& value);

  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// Reads what ByteWriter wrote. All members throw InvalidInput if the bytes end too early.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  [[nodiscard]] std::uint8_t byte();
  /// Also throws InvalidInput above `max`.
  [[nodiscard]] std::uint64_t number(std::uint64_t max = UINT64_MAX);
  [[nodiscard]] std::string text();
  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  /// Bytes not read yet: no list can have more entries.
  [[nodiscard]] std::size_t rest() const { return rest_.size(); }

 private:
  std::span<const std::uint8_t> rest_;
};

/// Encodes an edit for the journal, about six bytes per run. The rectangles are omitted, since they
/// follow from the runs.
void write_edit(const Edit& edit, ByteWriter& out);

/// Throws InvalidInput for bytes that `write_edit` cannot have written.
[[nodiscard]] Edit read_edit(ByteReader& in);

}  // namespace episcope
