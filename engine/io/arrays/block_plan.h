// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/arrays/array_input.h"

#include <vector>

namespace episcope::io {

struct ArrayBlock {
  ArrayShape start;
  ArrayShape count;
};

/// Blocks that together are the whole array, in the order of the file, each of whole units and of
/// at most `elements`, unless one unit has more.
[[nodiscard]] std::vector<ArrayBlock> plan_blocks(const ArrayShape& shape, const ArrayShape& unit,
                                                  std::size_t elements);

}  // namespace episcope::io
