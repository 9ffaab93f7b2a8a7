// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

namespace episcope::io {

/// CRC-32 as PNG has it (ISO 3309).
[[nodiscard]] std::uint32_t checksum(std::span<const std::uint8_t> bytes);

}  // namespace episcope::io
