// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/arrays/array_file.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Puts arrays of equal shape together that are parts of one by their names, and leaves only the
/// whole in `entries`:
/// - r, g and b (also R, red, LF_r, of one group) as channels;
/// - a view each ([y][x], with channels last or first), numbered by row and column, or in a row:
///   view_00_00, 3/4, cam012. Three at least; numbers that are the same in all names say nothing.
///
/// The whole is called like its parts, with # for the numbers. Of a grid that is not full it is the
/// largest part without a gap (`part_to_open`), with a warning; without such a part it is an entry
/// of another kind that says what is missing.
void join_arrays(std::vector<ArrayEntry>& entries);

/// The cells of a cell array of MATLAB as one array, if all are views of one size, or maps; nothing
/// if they are not. `grid`: its lengths as stored, {columns, rows}.
[[nodiscard]] std::optional<ArrayEntry> joined_cells(const std::string& name,
                                                     const std::vector<ArrayEntry>& cells,
                                                     const ArrayShape& grid);

/// The parts of `entry`, opened, as one array along its first axes. They must not be empty.
[[nodiscard]] std::unique_ptr<ArrayInput> stacked(const std::filesystem::path& path,
                                                  const ArrayEntry& entry,
                                                  std::vector<std::unique_ptr<ArrayInput>> parts);

/// The axes of an array of views that are parts, in the order of `entry.shape`.
[[nodiscard]] std::string joined_axes(const ArrayEntry& entry);

}  // namespace episcope::io
