// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

namespace episcope::io {

/// Makes room for 0 as "none"; the largest number stays.
inline void raise_label(std::int32_t& label) {
  if (label < std::numeric_limits<std::int32_t>::max()) ++label;
}

}  // namespace episcope::io
