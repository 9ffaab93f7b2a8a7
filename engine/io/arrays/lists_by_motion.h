// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/arrays/array_file.h"
#include "engine/io/arrays/array_layout.h"

#include <optional>
#include <vector>

namespace episcope::io {

/// Of several lists of views that an array of three axes can be, the one whose pictures lie on a
/// grid, or else along a line, as views do (find_list_layout): slices across views do not. Nothing
/// if none of them does, or several. Throws IoError.
[[nodiscard]] std::optional<ArrayLayout> list_by_motion(const ArrayFile& file,
                                                        const ArrayEntry& entry,
                                                        const std::vector<ArrayLayout>& layouts);

}  // namespace episcope::io
