// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/arrays/array_file.h"
#include "engine/io/arrays/array_layout.h"

#include <optional>
#include <vector>

namespace episcope::io {

/// Of several lists of views that an array of three axes can be, the one whose pictures lie on a
/// grid, as views do (find_list_layout) and slices across views do not; or else along a line, of
/// fewer views than they have rows and columns, since slices of any volume are much like a line.
/// Nothing if none of them does, or several. Throws IoError.
[[nodiscard]] std::optional<ArrayLayout> list_by_motion(const ArrayFile& file,
                                                        const ArrayEntry& entry,
                                                        const std::vector<ArrayLayout>& layouts);

}  // namespace episcope::io
