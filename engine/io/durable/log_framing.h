// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace episcope::io {

using LogRecord = std::vector<std::uint8_t>;

/// How the records of a log are stored in its file.
enum class LogFraming {
  Lines,    ///< Text: a record is a line, and holds no line break.
  Checked,  ///< Binary: a signature, then every record after its length and a checksum.
};

/// What a log without records consists of.
[[nodiscard]] std::span<const std::uint8_t> log_signature(LogFraming framing);

/// Adds a record to the bytes of a log. Throws InvalidInput if it is longer than 2 GiB.
void put_record(LogFraming framing, std::span<const std::uint8_t> record,
                std::vector<std::uint8_t>& bytes);

struct LogContent {
  std::vector<LogRecord> records;
  std::size_t whole_bytes = 0;  ///< Of the signature and these records.
};

/// The records up to the first that is truncated or damaged, as the end of the program in the
/// middle of a write leaves it. Nothing if these are not the bytes of such a log.
[[nodiscard]] std::optional<LogContent> parse_log(LogFraming framing,
                                                  std::span<const std::uint8_t> bytes);

}  // namespace episcope::io
