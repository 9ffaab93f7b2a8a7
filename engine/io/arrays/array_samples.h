// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/arrays/array_input.h"
#include "engine/io/arrays/array_layout.h"

#include <string>

namespace episcope::io {

/// Samples of views, and which of their pixels hold something.
struct ArraySamples {
  LightField::Samples samples;
  /// From a fourth channel, a weight or alpha: 0 = nothing was seen. Empty if there is none, or no
  /// zero in it.
  ViewStack<std::uint8_t> valid;
  /// Of a fourth channel that is no weight, such as depth, and left out: why it is none.
  std::string left_out{};
};

/// Reads a whole light field once, in blocks of at most 64 MB in the order of the file (whole
/// chunks of a compressed one), and brings each into the order of views, `[v][u][y][x][c]`. Types:
/// bytes and booleans become uint8, other integers uint16 (uint8 if none is above 255; clipped, but
/// float if one is negative), floats float as stored. Views of a list lie in one row. Throws
/// IoError, also if the views exceed the memory of this machine; Cancelled.
[[nodiscard]] ArraySamples read_samples(const ArrayInput& array, const ArrayLayout& layout,
                                        const Progress& progress);

/// Reads maps `[v][u][y][x]` that have the layout of a light field but no channels.
template <class T>
[[nodiscard]] ViewStack<T> read_map_stack(const ArrayInput& array, const ArrayLayout& layout,
                                          const Progress& progress);

}  // namespace episcope::io
