// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/block_plan.h"

#include <algorithm>

namespace episcope::io {

std::vector<ArrayBlock> plan_blocks(const ArrayShape& shape, const ArrayShape& unit,
                                    std::size_t elements) {
  // From the last axis on, a block takes as many units as fit.
  ArrayShape step(shape.size());
  std::size_t size = 1;
  for (std::size_t axis = 0; axis < shape.size(); ++axis) {
    step[axis] = std::min(unit[axis], shape[axis]);
    size *= step[axis];
  }
  for (std::size_t axis = shape.size(); axis-- > 0;) {
    size /= step[axis];
    const std::size_t units = std::max<std::size_t>(elements / (size * step[axis]), 1);
    step[axis] = std::min(units * step[axis], shape[axis]);
    size *= step[axis];
  }
  std::vector<ArrayBlock> blocks;
  ArrayShape at(shape.size(), 0);
  for (;;) {
    ArrayBlock block{at, step};
    for (std::size_t axis = 0; axis < shape.size(); ++axis) {
      block.count[axis] = std::min(step[axis], shape[axis] - at[axis]);
    }
    blocks.push_back(std::move(block));
    std::size_t axis = shape.size();
    while (axis > 0 && (at[axis - 1] += step[axis - 1]) >= shape[axis - 1]) at[--axis] = 0;
    if (axis == 0) return blocks;
  }
}

}  // namespace episcope::io
